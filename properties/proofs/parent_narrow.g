# The conservative parent of core/arithmetic/robust.h in binary32, u = 2^-24: parent().
#
# Notation: D = |b - a| exactly, d its computed value, h the computed half_span, H = (D + ra + rb) / 2 exactly; t the
# computed part of the way, P_x = t * dx; every r is the relative error of one operation. Nothing overflows or underflows
# by safe_square_min = 2^-90, safe_square_max = 2^120 and safe_radius_max = 2^120: d is above 2^-46.
#
# Proved:
# 1. contained_slack = 1 - 8u: if d + rb <= ra * contained_slack as computed, then D + rb <= ra: a encloses b.
# 2. From d = D * D1 it follows that h = H * H1, where H1 lies between the least and the greatest product of D1, r2, r3.
#    In units of largest = max(h, ra, rb), without drift:
#    |c - a| + ra <= ra + (h - ra) * TD * P <= needed_a, TD being t * D / (h - ra);
#    |c - b| + rb <= (D + ra + rb) - h + |TD - 1| + D * |P - 1| <= needed_b, as D + ra + rb = 2 h / H1.
#    Where t is clamped to 0, |c - a| + ra = ra and |c - b| + rb = 2 H - ra <= needed_b, as h <= ra; where it is clamped to
#    1, less than above.
# 3. The drift is known to a relative error of 5u (at most 4 roundings, each 1u), but where |P_x| > |a.x| the difference
#    c.x - a.x is rounded: that costs u (|P_x| + |P_y| + |P_z|) <= sqrt(3) u |P| more, the last terms below.
# 4. parent_slack = 1 + 32u, after its own 2 roundings still 1 + 29u, covers both: at most 24u and 5u are needed.

D1 = sqrt(1 + eq) * (1 + r1);                                 # the error of q, overlap_narrow.g, and of sqrt
H1 = D1 * (1 + r2) * (1 + r3);                                # (d + ra) + rb
TD = (1 + r4) * (1 + r5) / D1;                                # (half_span - ra) / d
P = (1 + r6) * (1 + r7);                                      # dx, and its product with t
rounded_difference = 1b-24 * 1.7320508075688774 / (1 - 1b-24);
needed_a = TD * P * (1 + rounded_difference);
needed_b = 2 / H1 - 1 + |TD - 1| + (2 / H1) * (|P - 1| + P * rounded_difference);
contained = (1 - 8b-24) * (1 + r8) / (D1 * (1 + r9));         # an upper bound of (D + rb) / ra
covered = (1 + 32b-24) * (1 + r8) * (1 + r9);                 # the radius: a product and a sum

{ |eq| <= 2.9861927032470704e-7                               # 5.01u
  /\ |r1| <= 1b-24 /\ |r2| <= 1b-24 /\ |r3| <= 1b-24 /\ |r4| <= 1b-24 /\ |r5| <= 1b-24 /\ |r6| <= 1b-24
  /\ |r7| <= 1b-24 /\ |r8| <= 1b-24 /\ |r9| <= 1b-24
  -> contained <= 1 /\ needed_a <= 1.00000143051147460937 /\ needed_b <= 1.00000143051147460937   # 1 + 24u
  /\ covered >= 1.00000172853469848632 }                       # 1 + 29u
