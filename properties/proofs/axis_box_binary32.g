# Boxes of core/space_tree/: that they hold their spheres (binary32: u = 2^-24).
#
# A sphere is at distance d from the origin along an axis, rounded once: d (1 + e1). Its reach is the radius r and
# slack = 32u of |d| + r on top, with at most five roundings, and a side of the box d minus or plus that, rounded once. What
# is shown: the reach outweighs what was rounded, so that the side lies beyond d - r or d + r. Factors of |d| and of r;
# the last rounding is of at most |d| (1 + u) and the reach.
# Boxes of nodes are the least and greatest sides of others, and two boxes are compared exactly.
#
# shown: space_evidence.cpp shows a side F, relative to the origin O, as O + (F + h) in binary64, with h = tiny / 2 inwards:
#   between the side that the search compares and the spheres, so that both what is passed over and what is enclosed can be
#   checked. Lengths are at most 2^20 (block_tree.h), so |O| is, and |F| is below 2^22. Of the reach's `tiny`, which nothing
#   above has needed, there is left what is shown, `left`; what binary64 rounds off, at most `lost`, is less than either.
# The last product, by a power of two, is exact.
# Covers: slack = 32u, tiny = 2^-28.

reach_d = 32b-24 * (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) * (1 + e5);
reach_r = (1 + 32b-24 * (1 + e2) * (1 + e3)) * (1 + e4) * (1 + e5);
beyond_d = reach_d - 1b-24 - 1b-24 * (1 + 1b-24 + reach_d);
beyond_r = reach_r - 1 - 1b-24 * reach_r;

@d = float<53, -4000, ne>;
left = 1b-28 * (1 + e5) - 1b-24 * (1b-28 * (1 + e5)) - 1b-29;
shown = d(O + d(F + 1b-29));
lost = shown - (O + (F + 1b-29));
inwards = 1b-29 + lost;
enclosing = left - lost;

{ |e1| <= 1b-24 /\ |e2| <= 1b-24 /\ |e3| <= 1b-24 /\ |e4| <= 1b-24 /\ |e5| <= 1b-24
  /\ |O| <= 1048576 /\ |F| <= 4194304                                              # 2^20, 2^22
  -> beyond_d >= 0 /\ beyond_r >= 0 /\ inwards >= 0 /\ enclosing >= 0 }
