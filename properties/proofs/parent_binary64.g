# The conservative parent of core/arithmetic/robust.h in binary64, u = 2^-53: parent_in_binary64().
#
# Proved for parent_binary64_slack = 1 + 2^-48 = 1 + 32u, every r being the relative error of one operation:
# 1. if (d + rb) * parent_binary64_slack <= ra as computed, then D + rb <= ra exactly: a encloses b;
# 2. the radius (distance(c, a) + ra) * parent_binary64_slack, measured from the rounded centre and before round_up, is at
#    least |c - a| + ra exactly, whatever the centre.
# Differences of binary32 numbers neither overflow nor underflow in binary64, nor do their squares.

D1 = sqrt(1 + eq) * (1 + r1);                                 # the error of q, overlap_binary64.g, and of sqrt
enclosing = D1 * (1 + r2) * (1 + 1b-48) * (1 + r3);           # computed over exact; ra alone has no D1, and is covered
enclosing_ra = (1 + r2) * (1 + 1b-48) * (1 + r3);

{ |eq| <= 5.562217353372034e-16                               # 5.01u
  /\ |r1| <= 1b-53 /\ |r2| <= 1b-53 /\ |r3| <= 1b-53
  -> enclosing >= 1 /\ enclosing_ra >= 1 }
