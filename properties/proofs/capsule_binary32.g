# Capsules of core/blocks/: that they enclose, and that only what is separate is called so (binary32: u = 2^-24).
#
# A capsule is stored with the half axis h and the radius r, computed with `slack` = 32u of its reach |h| + r on top. What
# is shown and promised is the radius less 16u of the reach: the *bare* radius. All sums below are linear in lengths, so
# that it is enough that the factor of each length has the right sign; e1 .. e9 are single roundings, d the error of a
# scalar product (dot_binary32.g: 5.01u).
#
# enclose: a sphere of radius R at the computed distance E from a point of the axis at most |h| along it truly is at most
#   E (1 + 3u) + 2u |h| away from it (differences and products each rounded once). The bare radius is at least that + R.
# separate: |t.w| - |a.w| - |b.w| > (ra + rb) |w| computed, with 32u of the sum of t's sides on top, means the same
#   exactly, for bare radii: factors of |t|, of |a| (or |b|) and of ra (or rb), over |w|. The squares that are compared
#   cost 4.1u: root. By 2^-47 each the gaps are wrong for underflow (underflow_binary32.g).
# ordered: of two spheres of a window, `slack` = 32u times far times length outweighs the rounding of both ends.
# The gap between them is rounded once more, by 1u of itself at most, and then compared with the slack.
# interval: a capsule reaches along an axis of length at most 1 + 11u (oriented_box_binary32.g) no farther than computed.
# Covers: slack = 32u, the bare radius's 16u, centre_slack = 16u, axes_slack = 128u.

# Lower bound of the stored radius: E's, R's and |h|'s factor.
stored_e = (1 + d1) * (1 + e1) * (1 + e2) * (1 + 32b-24 * (1 + e3) * (1 + e4)) * (1 + e5);
stored_r = (1 + e2) * (1 + 32b-24 * (1 + e3) * (1 + e4)) * (1 + e5);
stored_h = 32b-24 * (1 + d2) * (1 + e6) * (1 + e3) * (1 + e4) * (1 + e5);
# The bare radius is stored - 16u (|h| + stored).
enclose_e = stored_e * (1 - 16b-24) - (1 + 3b-24);
enclose_r = stored_r * (1 - 16b-24) - 1;
enclose_h = stored_h * (1 - 16b-24) - 16b-24 - 2b-24;

root = (1 - 2.4437904357910154e-07);
separate_t = 32b-24 * (1 - 4b-24) * (1 + e1) * root - 4.887580871582031e-07;
separate_a = 16b-24 - 2.992153167724609e-07 * (1 + 3b-24);
separate_r = (1 + e1) * (1 + e2) * root - (1 - 16b-24);
squares = (1 + e1) * (1 + e2) * (1 + d1) - root * root * (1 + e3) * (1 + 1b-45);

# Each end is wrong by 6.1u + 2u of far * length at most.
ordered = 32b-24 * (1 + e1) * (1 + e2) * (1 + e3) * (1 - 5b-24) - 2 * 4.887580871582031e-07;

interval_t = 16b-24 * (1 - 4b-24) * (1 + e1) * (1 + e2) * (1 + e3) - 4.291534423828125e-07 * (1 + 11b-24);
interval_h = 16b-24 - (2.992153167724609e-07 + 3b-24) * (1 + 11b-24);
interval_r = (1 + 128b-24) * (1 + e1) * (1 + e2) * (1 + e3) * (1 + e4) - (1 - 16b-24) * (1 + 11b-24);

{ |e1| <= 1b-24 /\ |e2| <= 1b-24 /\ |e3| <= 1b-24 /\ |e4| <= 1b-24 /\ |e5| <= 1b-24 /\ |e6| <= 1b-24
  /\ |d1| <= 2.98619270324707e-07 /\ |d2| <= 2.98619270324707e-07
  -> enclose_e >= 0 /\ enclose_r >= 0 /\ enclose_h >= 0
  /\ separate_t >= 0 /\ separate_a >= 0 /\ separate_r >= 0 /\ squares >= 0
  /\ ordered >= 0 /\ interval_t >= 0 /\ interval_h >= 0 /\ interval_r >= 0 }
