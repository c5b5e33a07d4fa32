# The overlap filter of core/arithmetic/robust.h, stage 2 (binary64: u = 2^-53).
#
# Proved, with and without fused multiply-add, for exact differences X, Y, Z of coordinates and an exact sum S of radii:
#   q, the computed X^2 + Y^2 + Z^2, has a relative error of at most 5.01u;
#   t, the computed S^2, has a relative error of at most 3.01u;
#   if exactly Q <= T, then q <= t * binary64_slack, rounded: `separate` is never wrong;
#   if exactly Q >= T, then q * binary64_slack, rounded, >= t: `overlap` is never wrong.
# A coordinate difference of 0 contributes nothing, rounded or not, and squares do not know the sign: positive is enough.
# The float format below has no least exponent. What underflow adds (nothing: squares of sums of binary32 numbers are 0 or above 2^-298) is n, relative to T.
# Covers: binary64_slack = 1 + 10u.

@f = float<53, -4000, ne>;
dx = f(X); dy = f(Y); dz = f(Z); s = f(S);
q f= dx * dx + dy * dy + dz * dz;
q_fused = f(f(f(dx * dx) + dy * dy) + dz * dz);
Q = X * X + Y * Y + Z * Z;
t f= s * s;
T = S * S;

# r is Q / T where that is at most 1, w is T / Q there; eq, et the errors of q and t; er that of the product.
wrongly_separate = r * (1 + eq) + n - (1 + et) * (1 + 10b-53) * (1 + er);
wrongly_overlap = w * (1 + et) + n - ((1 + eq) * (1 + 10b-53)) * (1 + er);

{ X in [1b-200,1b200] /\ Y in [1b-200,1b200] /\ Z in [1b-200,1b200] /\ S in [1b-200,1b200]
  /\ r in [0,1] /\ w in [0,1] /\ |n| <= 0 /\ |er| <= 1b-53
  /\ |eq| <= 5.56221735337204e-16 /\ |et| <= 3.341771304121725e-16
  -> |q -/ Q| <= 5.562217353372034e-16 /\ |q_fused -/ Q| <= 5.562217353372034e-16 /\ |t -/ T| <= 3.341771304121721e-16   # 5.01u, 5.01u, 3.01u
  /\ wrongly_separate <= 0 /\ wrongly_overlap <= 0 }
