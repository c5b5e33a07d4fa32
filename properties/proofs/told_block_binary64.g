# The capsule around a block that a rank tells others of (core/ranks/told_block.cpp), in binary64, u = 2^-53. All is
# homogeneous, so axis and way are scaled by one power of two to components of at most 1, the greatest of at least 1/2,
# and the direction across by another, likewise; nothing overflows or is lost, as squares of binary32 and their squares
# are numbers of binary64.
#
# Proved, for exact differences A (axis) and T (way) of centres, any part of the axis and any direction w:
# 1. a component of what leads across is wrong by at most 5u, so its length by less than 9u;
# 2. the gap at the first end is wrong by at most 9u, that at the last by at most 20u;
# 3. the slack, times the length of the direction, is more: 2^-40 (|A|1 + |T|1) is at least 2^-41 here, |w| at least 1/2;
# 4. and more than the errors of both squares and of the sums of radii, 8u in all, make of a gap that is no longer than
#    the way, of length at most root3.

@r = float<ieee_64, ne>;

t = r(T);
a = r(A);
across r= t - part * a;
Across = T - part * A;

tx = r(Tx); ty = r(Ty); tz = r(Tz);
ax = r(Ax); ay = r(Ay); az = r(Az);
first r= tx * wx + ty * wy + tz * wz;
First = Tx * wx + Ty * wy + Tz * wz;
along r= ax * wx + ay * wy + az * wz;
Along = Ax * wx + Ay * wy + Az * wz;
last r= first - along;
Last = First - Along;

slack = 1b-40 * sides;
half_slack = slack * 0.5;
lost_across = 9b-53;
lost_gap = 20b-53 + root3 * 8b-53;
more = slack - lost_across;
much_more = half_slack - lost_gap;

{ |T| <= 1 /\ |A| <= 1 /\ part in [0,1]
   /\ |Tx| <= 1 /\ |Ty| <= 1 /\ |Tz| <= 1 /\ |Ax| <= 1 /\ |Ay| <= 1 /\ |Az| <= 1
   /\ |wx| <= 1 /\ |wy| <= 1 /\ |wz| <= 1
   /\ sides in [0.5,6] /\ root3 in [1.732, 1.7320509]
  -> |across - Across| <= 5b-53
  /\ |first - First| <= 9b-53 /\ |last - Last| <= 20b-53
  /\ more >= 0 /\ much_more >= 0 }
