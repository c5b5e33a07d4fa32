# What told_block_binary64.g proves, of the lanes of binary32 in which ranks look first (core/ranks/told_lanes-inl.h):
# u = 2^-24, sums in another order, products and sums rounded together or not, and 2^-16 of slack.
#
# The format below has no least exponent: sums of products have 2^-110 on top, and so has what the square of a gap is
# compared with, which is above 2^-55 then; reaches, and radii, have 2^-50 on top. So what underflow costs, some 2^-147 a
# product, is less than 2^-46 of any of it. What overflows is never less than anything, so certain of nothing.
#
# Proved, as there, for parts of the axis and directions that are any:
# 1. a component of what leads across is wrong by at most 5u, so its length by less than 9u;
# 2. the gap at the first end is wrong by at most 9u, that at the last by at most 20u;
# 3. the slack is at least 2^-17, times the length of the direction at least 2^-18: more than either, and 8u of a gap
#    that is no longer than the way.

@r = float<24, -4000, ne>;

t = r(T);
a = r(A);
part_of_axis = part * a;
plain_across = r(t - r(part_of_axis));
fused_across = r(t - part_of_axis);
Across = T - part * A;

tx = r(Tx); ty = r(Ty); tz = r(Tz);
ax = r(Ax); ay = r(Ay); az = r(Az);
plain_first = r(r(tx * wx) + r(r(ty * wy) + r(tz * wz)));
fused_first = r(tx * wx + r(ty * wy + r(tz * wz)));
First = Tx * wx + (Ty * wy + Tz * wz);
plain_along = r(r(ax * wx) + r(r(ay * wy) + r(az * wz)));
fused_along = r(ax * wx + r(ay * wy + r(az * wz)));
Along = Ax * wx + (Ay * wy + Az * wz);
plain_last = r(plain_first - plain_along);
fused_last = r(fused_first - fused_along);
Last = First - Along;

slack = 1b-16 * sides;
half_slack = slack * 0.5;
lost_across = 9b-24;
lost_gap = 20b-24 + root3 * 8b-24;
more = slack - lost_across;
much_more = half_slack - lost_gap;

{ |T| <= 1 /\ |A| <= 1 /\ part in [0,1]
   /\ |Tx| <= 1 /\ |Ty| <= 1 /\ |Tz| <= 1 /\ |Ax| <= 1 /\ |Ay| <= 1 /\ |Az| <= 1
   /\ |wx| <= 1 /\ |wy| <= 1 /\ |wz| <= 1
   /\ sides in [0.5,6] /\ root3 in [1.732, 1.7320509]
  -> |plain_across - Across| <= 5b-24 /\ |fused_across - Across| <= 5b-24
  /\ |plain_first - First| <= 9b-24 /\ |fused_first - First| <= 9b-24
  /\ |plain_last - Last| <= 20b-24 /\ |fused_last - Last| <= 20b-24
  /\ more >= 0 /\ much_more >= 0 }
