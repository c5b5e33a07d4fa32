# The conservative parent of core/arithmetic/robust.h in binary32, u = 2^-24: parent().
#
# Notation: D = |b - a|, E = rb - ra, S = ra + rb and H = (D + S) / 2 exactly; d, e, h computed, h the half_span; t the
# computed part of the way, P_x = t * dx; every r is the relative error of one operation. Nothing overflows by
# safe_square_max = 2^120 but a sum of radii, which makes the radius infinite; d is above 2^-46 by
# safe_square_min = 2^-90, so that what underflows, n of t and n of the centre relative to H, is below 2^-90.
#
# Proved:
# 1. contained_slack = 1 + 6u: if d * contained_slack <= |e| as computed, then D <= |E|: the larger sphere encloses the
#    other. Otherwise |E| <= D * kappa.
# 2. Exactly, the centre belongs at T = 1/2 + x of the way, x = E / (2 D), where D T + ra = D (1 - T) + rb = H. With
#    t = T + dt and y = D / H, that is at most 2, in units of H:
#    inside, 0 <= T <= 1: |c - a| + ra and |c - b| + rb are at most 1 + y |dt| + D |t| |P - 1|, and D |t| <= 1 + y |dt|;
#    outside, T < 0 or T > 1, thus S >= |E| > D and y <= 1, and T is outside by at most (kappa - 1) / 2: D times twice that more.
#    The computed h is at least H * H1.
# 3. The drift is known to a relative error of 5u (at most 4 roundings, each 1u), but where |P_x| > |a.x| the difference
#    x - a.x is rounded: that costs u (|P_x| + |P_y| + |P_z|) <= sqrt(3) u |P| more, rounded_difference.
# 4. parent_slack = 1 + 32u, after its own 2 roundings still 1 + 29u, covers both: at most 25u and 5u are needed.

D1 = sqrt(1 + eq) * (1 + r1);                                 # the error of q, overlap_binary32.g, and of sqrt
kappa = D1 * (1 + 6b-24) * (1 + r3) / (1 + r2);               # (d * contained_slack) / |e| over D / |E|
H1 = (1 + (y * (D1 - 1) + z * r6) / 2) * (1 + r7);            # d + (ra + rb), z = S / H
X1 = (1 + r2) * (1 + r4) / D1;                                # 0.5 * e / d over x
P = (1 + r8) * (1 + r9);                                      # dx, and its product with t
rounded_difference = 1b-24 * 1.7320508075688774 / (1 - 1b-24);
dt_inside = x * (X1 - 1) + (0.5 + x * X1) * r5 + n;
dt_outside = x_out * (X1 - 1) + (0.5 + x_out * X1) * r5 + n;
inside = 1 + y * |dt_inside|;
outside = 1 + y_out * (k - 1 + |dt_outside|);
needed_inside = (inside + inside * (|P - 1| + P * rounded_difference) + n) / H1;
needed_outside = (outside + outside * (|P - 1| + P * rounded_difference) + n) / H1;
covered = (1 + 32b-24) * (1 + r10) * (1 + r11);               # the radius: a sum and a product

{ |eq| <= 2.9861927032470704e-7                               # 5.01u
  /\ |r1| <= 1b-24 /\ |r2| <= 1b-24 /\ |r3| <= 1b-24 /\ |r4| <= 1b-24 /\ |r5| <= 1b-24 /\ |r6| <= 1b-24
  /\ |r7| <= 1b-24 /\ |r8| <= 1b-24 /\ |r9| <= 1b-24 /\ |r10| <= 1b-24 /\ |r11| <= 1b-24
  /\ y in [0,2] /\ z in [0,2] /\ y_out in [0,1] /\ |x| <= 0.5 /\ |n| <= 1b-90
  /\ k in [1,1.00000068843364715577] /\ |x_out| <= 0.50000034421682357788   # 1 + 11.55u and half of that
  -> kappa in [1,1.00000068843364715577] /\ needed_inside <= 1.00000149011611938477
  /\ needed_outside <= 1.00000149011611938477                 # 1 + 25u
  /\ covered >= 1.00000172853469848632 }                      # 1 + 29u
