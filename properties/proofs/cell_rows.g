# Which rows and cells around a sphere core/cells/search_cells.h passes over (binary32: u = 2^-24).
#
# In units of a cell, a sphere's coordinates are V, computed v, and another's W and w, as in grid_cells.g: wrong by at most
# 2^-28 each below far_cell. If the other one's cell is the next above along an axis, then w >= floor(v) + 1, so W - V is at
# least 1 - (v - floor(v)) - 2^-27; likewise below. What overlaps is nearer than 1 - 2^-17 in all (grid_cells.g: reach, in
# exact arithmetic). `above` and `below` are those differences, computed in binary64 and rounded to binary32.
# Proved, for the differences a, b, c along three axes, each 0 where the cell is the same, and computed x, y, z:
#   where a^2 + b^2 + c^2 <= (1 - 2^-17)^2, the computed x*x + (y*y + z*z) is at most 1, so no such cell is passed over.
# Covers: off <= 1, along * along + off <= 1.

@f = float<24, -4000, ne>;
x = f(X); y = f(Y); z = f(Z);  # X, Y, Z: `above` before it is rounded, at most 2^-26 more than a, b, c
o f= y * y + z * z;
sum f= x * x + o;
S = a * a + (b * b + c * c);

{ a in [0,1] /\ b in [0,1] /\ c in [0,1] /\ X in [0,1] /\ Y in [0,1] /\ Z in [0,1]
  /\ X - a in [-1b-26,1b-26] /\ Y - b in [-1b-26,1b-26] /\ Z - c in [-1b-26,1b-26]
  /\ S in [0,0.9999847412691451609134674072265625]      # (1 - 2^-17)^2
  -> sum <= 1 }
