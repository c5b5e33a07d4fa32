# What core/cells/ adds to the capsules of core/blocks/ (binary32: u = 2^-24; capsule_binary32.g has all else).
#
# far_apart: spheres in two capsules collide only where the centres are no farther apart than the sum of the bare reaches,
#   a bare reach being (|h| + r) (1 - 16u) of the stored half axis h and radius r. If the computed square of the distance is
#   above the computed square of the sum of the stored reaches, the distance is above that sum: far > 0.
# ordered: with a window w, computed s_(i+w+1) - s_i > step, and s_i <= s_(i+1) as far as there is an i in the first block
#   and w on, so that s_j - s_i, as computed, is above step for all i there and j > i + w. In units of far * length, where far
#   is at least each centre's distance plus each radius: each s is wrong by 6.1u + 2u (capsule_binary32.g), 2 R length is
#   rounded once, the sum for step once, and the difference once; the slack of 32u outweighs it: steps > 0.
# width: the stored reach times 2 (1 + 2^-16) is above twice the bare reach: width > 0.
# Units of their own: all lengths of a block, or of a test of two, times a power of two, which changes no factor here. The
#   greatest of the block, or the way from one of the two to the other, is 1 to 2 then, unless it is too short for that and
#   less than what radii have on top; and the slack for it, at least 2^-20, outweighs by far what squares lose by
#   underflow, 2^-146. A test in which a length overflows says nothing.
# Covers: slack = 32u, the bare radius's 16u, 1 + 2^-16 of the width of a level's cells.

# Of a stored reach, over |h| + r: a square root of a computed square, and a sum.
stored = (1 - 1.5497207641601562e-07) * (1 + e1) * (1 + e2);
bare = 1 - 16b-24;
# The computed distance over the true one, squared: differences, then the scalar product; and the computed sum, squared.
distance = (1 + e3) * (1 + e3) * (1 + d1);
sum = (1 + e4) * (1 + e4) * (1 + e5);
far = stored * stored * sum - bare * bare * distance;

# |s_i|, |s_j| <= 1 + 9u, and 2 R length <= 2, in units of far * length.
step_wrong = 2 * 4.887580871582031e-07 + 2 * 1b-24 + (2 + 40b-24) * 1b-24 + (2 + 60b-24) * 1b-24;
steps = 32b-24 * (1 + e1) * (1 + e2) * (1 - 5b-24) - step_wrong;

width = stored * (1 + 1b-16) * (1 + e3) * (1 + e4) - bare;

{ |e1| <= 1b-24 /\ |e2| <= 1b-24 /\ |e3| <= 1b-24 /\ |e4| <= 1b-24 /\ |e5| <= 1b-24 /\ |d1| <= 2.98619270324707e-07
  -> far >= 0 /\ steps >= 0 /\ width >= 0 }
