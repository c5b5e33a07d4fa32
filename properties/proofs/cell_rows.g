# Which rows and cells around a sphere core/cells/search_cells.h passes over (binary32: u = 2^-24).
#
# In units of a cell, a sphere's coordinates are V, computed v, and another's W and w, as in grid_cells.g: wrong by at most
# 2^-28 each below far_cell. If the other one's cell is the next above along an axis, then w >= floor(v) + 1, so W - V is at
# least 1 - (v - floor(v)) - 2^-27; likewise below. `above` and `below` are those differences, computed in binary64 and
# rounded to binary32. What overlaps is at most (r + R) cells_per_unit away, R the level's greatest radius, of which
# R cells_per_unit is below 1/2. G is r cells_per_unit + 1/2; its computed value g is rounded in binary64, and to binary32.
# Proved, for the differences a, b, c along three axes, each 0 where the cell is the same, and computed x, y, z:
#   where a^2 + b^2 + c^2 <= G^2, the computed x*x + (y*y + z*z) is at most the computed g*g + 2^-20, so no such cell is
#   passed over.
# Covers: limit = reach * reach + 2^-20.

@f = float<24, -4000, ne>;
x = f(X); y = f(Y); z = f(Z);  # X, Y, Z: `above` before it is rounded, at most 2^-26 more than a, b, c
g = f(H);                      # H: the reach in binary64
o f= y * y + z * z;
sum f= x * x + o;
limit f= g * g + 1b-20;
S = a * a + (b * b + c * c);
D = S - G * G;

{ a in [0,1] /\ b in [0,1] /\ c in [0,1] /\ X in [0,1] /\ Y in [0,1] /\ Z in [0,1] /\ G in [0.25,1] /\ H in [0.25,1]
  /\ X - a in [-1b-26,1b-26] /\ Y - b in [-1b-26,1b-26] /\ Z - c in [-1b-26,1b-26] /\ H - G in [-1b-50,1b-50]
  /\ D <= 0 /\ S in [0,1]
  -> sum - limit <= 0 }

sum - limit -> ((sum - (X * X + (Y * Y + Z * Z))) - (limit - (H * H + 1b-20)))
             + (((X - a) * (X + a) + (Y - b) * (Y + b) + (Z - c) * (Z + c)) - (H - G) * (H + G) + D - 1b-20);
