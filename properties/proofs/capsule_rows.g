# Which rows and cells around a capsule core/cells/capsule_blocks.h passes over (binary32: u = 2^-24).
#
# Along one axis, in units of a cell, a power of two: a centre's coordinate V is exact, and so are its cell floor(V) and
# F = V - floor(V), in [0, 1). What lies in the next cell above is at least B = 1 - F away, and reaches back less than half a
# cell (a level's cells are as wide as two of its capsules at most reach). A capsule of the bare half axis H along the axis
# and radius R reaches H + R. If it touches something in that cell, then B < H + R + 1/2; below, F instead of B.
# The stored radius is at least the bare one (capsule_binary32.g), the half axis is stored as it is.
# Proved: where B <= H + R + 1/2, the computed 1 - F is at most the computed (h + r) + (1/2 + 2^-12), so that no such cell
#   is passed over.
# Covers: 0.5f + 0x1p-12f.

@f = float<24, -4000, ne>;
limit f= H + r + (0.5 + 1b-12);
border f= 1 - F;

{ H in [0,2] /\ r in [0,2] /\ R in [0,2] /\ F in [0,1] /\ r - R >= 0 /\ (1 - F) - (H + R + 0.5) <= 0
  -> border - limit <= 0 }

border - limit -> (border - (1 - F)) - (limit - (H + r + (0.5 + 1b-12))) + ((1 - F) - (H + R + 0.5)) - (r - R) - 1b-12;
