# Boxes of core/space_tree/: that they hold their spheres (binary32: u = 2^-24).
#
# A sphere is at distance d from the origin along an axis, rounded once: d (1 + e1). Its reach is the radius r and
# slack = 32u of |d| + r on top, with at most five roundings, and a side of the box d minus or plus that, rounded once. What
# is shown: the reach outweighs what was rounded, so that the side lies beyond d - r or d + r. Factors of |d| and of r;
# the last rounding is of at most |d| (1 + u) and the reach.
# Boxes of nodes are the least and greatest sides of others, and two boxes are compared exactly.
# Covers: slack = 32u.

reach_d = 32b-24 * (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5);
reach_r = (1 + 32b-24 * (1 + e2) * (1 + e3)) * (1 + e4) * (1 + e5);
beyond_d = reach_d - 1b-24 - 1b-24 * (1 + 1b-24 + reach_d);
beyond_r = reach_r - 1 - 1b-24 * reach_r;

{ |e1| <= 1b-24 /\ |e2| <= 1b-24 /\ |e3| <= 1b-24 /\ |e4| <= 1b-24 /\ |e5| <= 1b-24
  -> beyond_d >= 0 /\ beyond_r >= 0 }
