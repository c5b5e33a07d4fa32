# The cull of a search in cells, core/arithmetic/robust.h InRange::excess (binary32: u = 2^-24): q less greatest_square, with
# which the sum begins, so that each of the three squares may be a fused product.
#
# Proved, with and without fused multiply-add, of exact differences of coordinates with a sum of squares Q and an exact sum
# of radii with square T: if exactly Q <= T, what is computed is below 0, so that its sign is set.
# All relative to T, which is above 2^-90 and below 2^120. A, B, D are the exact squares; what is computed grows with each of
# them, so all may be as much too large as the worst of them is: by k, of e for its rounded difference and of p for its
# product, 0 where that is fused. et is the error of the computed T (overlap_binary32.g) and er that of its product with the
# slack; r1, r2 are those of the first two sums. What underflows (each product loses at most 2^-150) is n. The last sum's
# rounding leaves a sign as it is. An overflowing square is truly greater than T.
# Covers: binary32_slack = 1 + 12u,
#   safe_square_min = 2^-90, safe_square_max = 2^120.

c = (1 + et) * (1 + 12b-24) * (1 + er);
k = (1 + e) * (1 + p);
first = A * k - c;
second = first * (1 + r1) + B * k;
excess = second * (1 + r2) + D * k + n;

{ A in [0,1] /\ B in [0,1] /\ A + B + D in [0,1]
  /\ |e| <= 1.1920929665620834e-07    # not less than 2u + u^2
  /\ |p| <= 1b-24 /\ |et| <= 1.7940998077392598e-07 /\ |er| <= 1b-24 /\ |r1| <= 1b-24 /\ |r2| <= 1b-24 /\ n in [0,1b-57]
  -> excess <= -1b-24 }

excess -> (1 - c) + (A + B + D) * (k - 1) + ((A + B + D) - 1) + first * r1 + second * r2 + n;
