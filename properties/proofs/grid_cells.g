# The cells of core/grid/bucket_map.h (binary64: u = 2^-53).
#
# V and W are the exact products of two coordinates with cells_per_unit, v and w the computed ones. Where both are below
# far_cell = 2^25, and the coordinates differ by at most 2 r, V and W differ by at most 2 r cells_per_unit. Proved:
#   2 r cells_per_unit <= 1 - cell_slack / 2, as computed for the exact D = 2 r (a binary32 number times 2);
#   |v - w| <= 1, so the floors of v and w differ by at most 1.
# The float format below has no least exponent: products that underflow are far below 1, and both have the cell 0 or -1.
#
# Which cells of a coarser level lie near a box of centres (search_grid-inl.h, around_lanes-inl.h): two spheres overlap only
# where their centres are no farther apart along an axis than S, the sum of their radii. Proved, in units of S: `reach` is at
# least the rounded difference of two such coordinates, and so at least S. Then the one less reach, rounded, is not above the
# other, which is a number itself; and numbers and cells are in one order.
# Covers: cell_slack = 2^-16, far_cell = 2^25, 1 + 2^-40.

@d = float<53, -4000, ne>;
reach = (1 - 1b-16) * (1 + e);   # 2 r is exact, 1 - cell_slack too; e is the error of the quotient
outreach = (1 + e) * (1 + 1b-40) * (1 + e2) - (1 + e3);
v = d(V);
w = d(W);

{ |e| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53
  /\ |V| <= 33554433 /\ |W| <= 33554433 /\ |V - W| <= 0.99999237060546875          # 2^25 + 1; 1 - 2^-17
  -> reach <= 0.99999237060546875 /\ |v - w| <= 1 /\ outreach >= 0 }
