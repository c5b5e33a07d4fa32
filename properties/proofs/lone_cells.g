# The cells of core/lone_spheres/lone_cells.h (binary32: u = 2^-24).
#
# V and W are the exact products of two coordinates with cells_per_unit, at most most_cells = 2^16 and a little more for
# what was rounded when the width was chosen; v and w the computed ones. Two spheres overlap only if V and W differ by at
# most S, the greatest sum of two radii in cells; reach is S + rounding_slack, rounded by less than 2^-16. Proved:
#   v - reach, computed, is at most w, and v + reach at least w: so the cell of w, its floor, is neither before the
#   first that v reaches nor behind the last;
#   these differ by at most 1, so they are at most two cells.
# The float format below has no least exponent: products that underflow are far below the slack.
# Covers: rounding_slack = 2^-6, most_cells = 2^16, greatest_sum = 0.46.

@f = float<24, -4000, ne>;
v = f(V);
w = f(W);
low = f(v - reach);
high = f(v + reach);
least = 1b-6 - 1b-16;

{ |V| <= 65537 /\ |W| <= 65537 /\ V - W - S <= 0 /\ V - W + S >= 0
  /\ S in [0, 0.4600001] /\ reach - S - least >= 0 /\ reach in [0.0156, 0.4760001]
  -> low - w <= 0 /\ high - w >= 0 /\ high - low <= 1 }

low - w -> (low - (v - reach)) + (v - V) - (w - W) + (V - W - S) - (reach - S - least) - least;
high - w -> (high - (v + reach)) + (v - V) - (w - W) + (V - W + S) + (reach - S - least) + least;
high - low -> (high - (v + reach)) - (low - (v - reach)) + 2 * reach;
