# Oriented boxes of core/blocks/: how far they reach (binary32: u = 2^-24).
#
# A box is { p : |(p - c) . v_j| <= h_j }, with axes of which every computed product differs by less than axes_error = 16u
# from that of orthonormal ones. With V the matrix of the axes, V V' = I + D, and p - c = inverse(V) y, |y_j| <= h_j, the
# box reaches sum |z_j| h_j along a direction w, z = inverse(V') w = inverse(I + D) V w: that is V w but for
# |D inverse(I + D)| |V w|, in the maximum norm.
# Proved: an entry of D is below 21.1u, an axis is at most 1 + 11u long; so, for w another box's axis, z differs from the
# computed V w by at most 76u in each component, and the sum's own roundings (at most 5, of at most (1 + 80u) sum h) cost
# 6u: 82u in all, which axes_slack = 128u, itself rounded, outweighs. What is left of 16u of |t| is capsule_binary32.g's interval_t.
# Covers: axes_error = 16u, axes_slack = 128u.

entry = 16b-24 * (1 + e1) + 2.98619270324707e-07 * square;
norm = 3 * 1.2576580047607423e-06;
off = (norm / (1 - norm) + 2.98619270324707e-07) * square;
sum = 5b-24 * (1 + 80b-24) * square;

# square: of the greatest length of an axis, at most 1 + 21.1u.
{ |e1| <= 1b-24 /\ square in [1,1.0000012576580047]
  -> entry <= 1.2576580047607423e-06 /\ off <= 76b-24 /\ sum <= 6b-24 }
