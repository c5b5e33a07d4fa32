# The scalar product that core/blocks/ computes everything from (binary32: u = 2^-24).
#
# Proved, for exact products X, Y, Z of two vectors' components whose lengths multiply to at most 1, so that no product and
# no partial sum exceeds 1:
#   the computed sum differs from X + Y + Z by at most 3.01u with fused multiply-add and 5.01u without;
#   of a square, where all products are positive, by at most 5.01u of itself.
# The format below has no least exponent: what underflow costs is outweighed by BlockTree::tiny, see block_tree.h.

@f = float<24, -4000, ne>;
s_fused = f(X + f(Y + f(Z)));
plain = f(f(X) + f(f(Y) + f(Z)));
q_fused = f(A * A + f(B * B + f(C * C)));
q = f(f(A * A) + f(f(B * B) + f(C * C)));
Q = A * A + (B * B + C * C);

{ |X| <= 1 /\ |Y| <= 1 /\ |Z| <= 1 /\ |Y + Z| <= 1 /\ |X + (Y + Z)| <= 1
  /\ A in [1b-100,1b100] /\ B in [1b-100,1b100] /\ C in [1b-100,1b100]
  -> |s_fused - (X + (Y + Z))| <= 1.7940998077392577e-07 /\ |plain - (X + (Y + Z))| <= 2.98619270324707e-07
  /\ |q_fused -/ Q| <= 2.98619270324707e-07 /\ |q -/ Q| <= 2.98619270324707e-07 }
