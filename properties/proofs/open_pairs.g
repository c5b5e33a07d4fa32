# Which pairs of a kept list core/frames/near_pairs.cpp takes for settled (binary32: u = 2^-24).
#
# Two spheres whose radii are A together each stay within an inner skin of s: what one's centre moves and its radius changes
# is together at most its radius, thicker by s and rounded, less its radius: s and u of the radius and the skin. So they come
# nearer, or go apart, by at most W = 2s + 2u (A + 2s), of which half of 2u is needed.
# In units of A, where w is 2s / A and e1 to e4 are the errors of reach, the difference, the product and the result:
#   close, where it is not negative, is at most A - W: what overlaps by as much for certain still does.
# In units of A + 2s, where v is A / (A + 2s) and e5 to e7 are the errors of the sum, the product and the result:
#   far is at least A + W: what is farther apart still is.
# A sum of binary32 numbers that is subnormal is exact; a product that is may be wrong by 2^-150, less than u of a sum that is
# normal, and below that nothing overlaps for certain.
# Covers: reach_slack = 2^-20.

difference = (1 + e1 - w) * (1 + e2);
shortened = difference - (1 + e1) * 1b-20 * (1 + e3);
close = shortened * (1 + e4);
too_long = close - (1 - w - 1b-23 * (1 + w));
sum = (1 + e1 * v) * (1 + e5);
far = (sum + sum * 1b-20 * (1 + e6)) * (1 + e7);
too_short = (1 + 1b-23) - far;

{ |e1| <= 1b-24 /\ |e2| <= 1b-24 /\ |e3| <= 1b-23 /\ |e4| <= 1b-24 /\ |e5| <= 1b-24 /\ |e6| <= 1b-23 /\ |e7| <= 1b-24
  /\ w in [0,1.001] /\ v in [0,1] /\ shortened in [0,1.001]
  -> too_long <= 0 /\ too_short <= 0 }

too_long -> e1 + e2 * (1 + e1 - w) - (1 + e1) * 1b-20 * (1 + e3) + shortened * e4 + 1b-23 * (1 + w);
