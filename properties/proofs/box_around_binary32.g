# Boxes around spheres (core/hierarchy/box.h, and those who compute as it does): that they enclose (binary32: u = 2^-24).
#
# An end is a difference or sum V of centre and radius, rounded, and moved outward by |end| 2^-23, rounded. In a unit in
# which the end is between 2^23 and 2^24 a step between floats is 1 there. P and N are the exact low ends above and below 0;
# high ends are their mirror images. T is what the end is moved by: the product with a power of two is exact, but where it is
# subnormal. An end of at most 2^-125 is exact, as V is a multiple of the least float; above it T is off by 2^-150, a quarter
# of the step 2^-148 there, and at least one step still, as rounding is monotone. With fused multiply-add it is exact.
# Proved: the end, moved and rounded once more, lies at or beyond V.
# Covers: 0x1p-23f.

@f = float<24, -4000, ne>;
p = f(P);
n = f(N);
end_p = f(p - Tp);
end_n = f(n - Tn);
beyond_p = P - end_p;
beyond_n = N - end_n;
off_p = Tp - p * 1b-23;
off_n = Tn + n * 1b-23;

{ P in [8388608,16777216] /\ N in [-16777216,-8388608] /\ Tp >= 1 /\ Tn >= 1 /\ |off_p| <= 0.25 /\ |off_n| <= 0.25
  -> beyond_p >= 0 /\ beyond_n >= 0 }

beyond_p -> Tp - (end_p - (p - Tp)) - (p - P);
beyond_n -> Tn - (end_n - (n - Tn)) - (n - N);

$ P in (8388609, 16777213);
$ N in (-16777213, -8388609);
