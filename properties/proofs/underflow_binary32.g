# What underflow costs the bounds and tests of core/blocks/ and core/cells/, and that what they have on top outweighs it.
#
# A product that is subnormal is wrong by up to 2^-150, a sum is not; so a scalar product is wrong by up to 3 * 2^-150 more than
# dot_binary32.g has it: `lost`. All else is relative, and proved in capsule_binary32.g and block_capsule_binary32.g. Lengths
# are at most 2^22 (block_tree.h). u = 2^-24.
#
# In core/blocks/ all products have something on top (`least`), and no sum is subnormal:
#   whole: where `least` is least_square = 2^-80, a square is no less than it should be, but for u.
#   linear: what is on top of products that are subtracted from one another is rounded with them, by u each of three times and
#     of both; tiny = 2^-120, rounded twice itself, outweighs that for least_product = 2^-110, and for products without.
#   gap: in tests-inl.h `least` is 2^-98, three scalar products make a gap, and its square is compared with more than `least`.
#     One of no_gap = 2^-50 parts nothing (idle), and one that does is wrong by 2^-47 of itself at most.
# In core/cells/ nothing is on top; `tiny` of a radius is 2^-28 there, and squares below 2^-60 say nothing:
#   fitted: a distance whose square loses as much as u of it is below 2^-60; the radius's tiny outweighs it.
#   parted: the gap over |w|, where the computed |w|^2 is above 2^-60, against both radii's tiny.
#   normal: what a gap is compared with is no subnormal, nor is what a distance is: both are above 2^-126.
#   far: the square of a distance is wrong by less than 2^-90 of what it is compared with.
#   climbed: the square of a direction U loses as much as u of it only where |U|^2 < 3 * 2^-126 and |U| < 2^-62. But |U|^2 is
#     what spheres in order rise by, from one end of U to the other, and they are only where that is computed to be above
#     2^-60: wrong by 6u of 2^22 |U| at either end.
# Covers: tiny = 2^-120, least_square = 2^-80, least_product = 2^-110, 2^-98, 2^-50; 2^-28 and 2^-60 of core/cells/.

whole = 1b-80 * (1 - 1b-24) - lost;
linear = 1b-120 * (1 - 1b-24) * (1 - 1b-24) - 2 * (3b-24 * 1b-110 * (1 + 3b-24) + lost);
idle = 1b-98 - 1b-50 * 1b-50;
gap_least = 1b-49 * (1 - 4b-24);
gap_square = 1b-98 * (1 - 4b-24) - gap_least * gap_least;
gap = 1b-47 * gap_least - 3 * (1b-98 * (1 + 3b-24) + lost);
fitted = 1b-28 * (1 - 1b-24) - 1b-60;
fitted_square = 1b-24 * (1b-60 * 1b-60) - lost;
w_least = 1b-30 * (1 - 3b-24);
parted = 2 * (1b-28 * (1 - 1b-24)) * w_least - 3 * lost;
normal = (2b-28 * (1 - 2b-24)) * (2b-28 * (1 - 2b-24)) * 1b-60 * (1 - 2b-24) - 1b-126;
far = 1b-90 * ((2b-28 * (1 - 2b-24)) * (2b-28 * (1 - 2b-24))) - lost;
climbed = 1b-60 - 2 * (6b-24 * (1b22 * 1b-62) + lost) - 3b-126;

{ lost in [0,3b-150]
  -> whole >= 0 /\ linear >= 0 /\ idle >= 0 /\ gap_square >= 0 /\ gap >= 0
  /\ fitted >= 0 /\ fitted_square >= 0 /\ parted >= 0 /\ normal >= 0 /\ far >= 0 /\ climbed >= 0 }
