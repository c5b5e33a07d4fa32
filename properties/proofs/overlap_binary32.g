# The overlap filter of core/arithmetic/robust.h, stage 1 (binary32: u = 2^-24).
#
# Proved, with and without fused multiply-add, for exact differences X, Y, Z of coordinates and an exact sum S of radii:
#   q, the computed X^2 + Y^2 + Z^2, has a relative error of at most 5.01u;
#   t, the computed S^2, has a relative error of at most 3.01u;
#   if exactly Q <= T, then q <= t * binary32_slack + underflow_floor, both rounded: `separate` is never wrong, whatever
#     the range: where T is below 2^-91 underflow may cost up to 2^-146 in all, which the floor outweighs;
#   if exactly Q >= T, then q * binary32_slack, rounded, >= t: `overlap` is never wrong.
# A coordinate difference of 0 contributes nothing, rounded or not, and squares do not know the sign: positive is enough.
# The float format below has no least exponent. What underflow adds (each of at most 5 products loses 2^-150, and T is above 2^-91) is n, relative to T.
# Covers: binary32_slack = 1 + 12u,
#   underflow_floor = 2^-120, safe_square_min = 2^-90, safe_square_max = 2^120.

@f = float<24, -4000, ne>;
dx = f(X); dy = f(Y); dz = f(Z); s = f(S);
q f= dx * dx + dy * dy + dz * dz;
q_fused = f(f(f(dx * dx) + dy * dy) + dz * dz);
Q = X * X + Y * Y + Z * Z;
t f= s * s;
T = S * S;

# r is Q / T where that is at most 1, w is T / Q there; eq, et the errors of q and t; er, es those of the product and the
# sum (the floor itself only helps); lost is what underflow costs where T is tiny.
wrongly_separate = r * (1 + eq) + n - (1 + et) * (1 + 12b-24) * (1 + er) * (1 + es);
not_outweighed = lost - 1b-120 * (1 + es);
wrongly_overlap = w * (1 + et) + n - ((1 + eq) * (1 + 12b-24)) * (1 + er);

{ X in [1b-160,1b130] /\ Y in [1b-160,1b130] /\ Z in [1b-160,1b130] /\ S in [1b-160,1b130]
  /\ r in [0,1] /\ w in [0,1] /\ |n| <= 1b-57 /\ |er| <= 1b-24 /\ |es| <= 1b-24 /\ lost in [0,1b-146]
  /\ |eq| <= 2.9861927032470734e-07 /\ |et| <= 1.7940998077392598e-07
  -> |q -/ Q| <= 2.98619270324707e-07 /\ |q_fused -/ Q| <= 2.98619270324707e-07 /\ |t -/ T| <= 1.7940998077392577e-07   # 5.01u, 5.01u, 3.01u
  /\ wrongly_separate <= 0 /\ wrongly_overlap <= 0 /\ not_outweighed <= 0 }
