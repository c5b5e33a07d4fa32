# The test by which core/frames/ says that a sphere lies within another (core/frames/within.h; binary32: u = 2^-24).
#
# The room M = rb - ra is computed as m, 1u off, and q is the computed square of the distance, whose exact value is D.
# As `within` wants m >= within_least = 2^-60, M^2 is above 2^-121, and so is D where the sphere is not within; underflow
# of q's products costs at most 2^-146 in all: n, relative to D, is at most 2^-25. m <= within_greatest = 2^60, so that m * m is
# finite; a q that is infinite or no number is not within.
# Proved, r being M^2 / D where the sphere is not within, so that r < 1; eq, et the errors of q and m * m
#   (overlap_binary32.g, where t is the square of a sum as m * m is of a difference):
#   q * within_slack, rounded, is above m * m, so that `within` is never said of what is not.
# Covers: within_slack = 1 + 16u, within_least = 2^-60, within_greatest = 2^60.

least_square_of_room = 1b-60 * (1 - 1b-24) * (1b-60 * (1 - 1b-24));
lost = 1b-146 - 1b-25 * least_square_of_room;
above = (1 + eq - n) * (1 + 16b-24) * (1 + er) - r * (1 + et);

{ r in [0,1] /\ n in [0,1b-25] /\ |er| <= 1b-24 /\ |eq| <= 2.9861927032470734e-07 /\ |et| <= 1.7940998077392598e-07
  -> above >= 1b-24 /\ lost <= 0 }
