// The axes along which sixteen clouds of points are longest and flattest, lane = cloud.
#if defined(CATENA_CORE_BLOCKS_PRINCIPAL_AXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_PRINCIPAL_AXES_INL_H
#undef CATENA_CORE_BLOCKS_PRINCIPAL_AXES_INL_H
#else
#define CATENA_CORE_BLOCKS_PRINCIPAL_AXES_INL_H
#endif

#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// 0 for what is nearer to it: along axes with next to nothing in them products are subnormal.
HWY_INLINE Vectors without_less_than(float least, const Vectors& v) {
  Lanes16 zero = Lanes16::all(0), limit = Lanes16::all(least);
  return {select(abs(v.x) < limit, zero, v.x), select(abs(v.y) < limit, zero, v.y),
          select(abs(v.z) < limit, zero, v.z)};
}

/// Symmetric 3 x 3 matrices, a lane.
struct Symmetric {
  Lanes16 xx, xy, xz, yy, yz, zz;

  /// Next to nothing: sums of products that start with it are normal.
  static HWY_INLINE Symmetric least() {
    Lanes16 v = Lanes16::all(least_product);
    return {v, v, v, v, v, v};
  }
  HWY_INLINE Symmetric without_less_than(float least) const {
    Vectors x = HWY_NAMESPACE::without_less_than(least, Vectors{xx, xy, xz}),
            z = HWY_NAMESPACE::without_less_than(least, Vectors{yy, yz, zz});
    return {x.x, x.y, x.z, z.x, z.y, z.z};
  }
  HWY_INLINE Lanes16 trace() const { return xx + yy + zz; }
  HWY_INLINE Symmetric scaled(const Lanes16& s) const {
    return {xx * s, xy * s, xz * s, yy * s, yz * s, zz * s};
  }
  HWY_INLINE Symmetric plus(const Symmetric& m) const {
    return {xx + m.xx, xy + m.xy, xz + m.xz, yy + m.yy, yz + m.yz, zz + m.zz};
  }
  HWY_INLINE Symmetric plus_square_of(const Vectors& v) const {
    return {mul_add(v.x, v.x, xx), mul_add(v.x, v.y, xy), mul_add(v.x, v.z, xz),
            mul_add(v.y, v.y, yy), mul_add(v.y, v.z, yz), mul_add(v.z, v.z, zz)};
  }
  /// With trace 1, unless it is 0.
  HWY_INLINE Symmetric normalized() const {
    return scaled(Lanes16::all(1) / max(trace(), Lanes16::all(1e-36f)));
  }
  HWY_INLINE Symmetric squared() const {
    Vectors x{xx, xy, xz}, y{xy, yy, yz}, z{xz, yz, zz};
    return {dot(x, x), dot(x, y), dot(x, z), dot(y, y), dot(y, z), dot(z, z)};
  }
  /// The adjugate: the same eigenvectors, the greatest for the least.
  HWY_INLINE Symmetric adjugate() const {
    return {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy,
            xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
  }
  /// The column of the greatest diagonal element: after some squarings the eigenvector of the greatest
  /// eigenvalue.
  HWY_INLINE Vectors main_column() const {
    Flags<16> y = xx < yy;
    Lanes16 greater = max(xx, yy);
    Flags<16> z = greater < zz;
    return {select(z, xz, select(y, xy, xx)), select(z, yz, select(y, yy, xy)),
            select(z, zz, select(y, yz, xz))};
  }
};

HWY_INLINE Vectors scaled(const Vectors& v, const Lanes16& s) { return {v.x * s, v.y * s, v.z * s}; }
HWY_INLINE Vectors unit(const Vectors& v) { return scaled(v, Lanes16::all(1) / sqrt(dot(v, v))); }
HWY_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Orthonormal to within BlockTree::axes_error, checked: where the guess is not, the axes of space are taken.
/// A guess by eight powers of the covariance, longest first, and of its adjugate, flattest last.
HWY_INLINE void principal_axes(const Symmetric& covariance, Vectors (&axis)[3]) {
  Lanes16 one = Lanes16::all(1), zero = Lanes16::all(0);
  Symmetric longest = covariance.normalized(), flattest = longest.adjugate();
  Flags<16> line = flattest.trace() < Lanes16::all(1e-5f);  // then only the longest is sharp
  flattest = flattest.normalized();
  for (int k = 0; k < 3; ++k)
    longest = longest.squared().normalized(), flattest = flattest.squared().normalized();
  Vectors t = unit(longest.main_column()), n = unit(flattest.main_column());
  Vectors kept = select(line, t, n);
  Vectors turned = select(line, n, t);
  const auto turn = [&] { turned = minus(turned, dot(kept, turned), kept); };
  turn();
  // Where the two were one, any direction across will do: the axis of space that is least along it.
  Lanes16 x = abs(kept.x), y = abs(kept.y), z = abs(kept.z);
  Flags<16> least_x = (x <= y) & (x <= z), least_y = y <= z;
  Vectors across = select(least_x, Vectors{one, zero, zero},
                          select(least_y, Vectors{zero, one, zero}, Vectors{zero, zero, one}));
  turned = select(Lanes16::all(1e-3f) < dot(turned, turned), turned, across);
  turn();
  turned = unit(turned);
  turn();
  turned = unit(turned);
  axis[0] = select(line, kept, turned), axis[2] = select(line, turned, kept);
  axis[1] = cross(axis[2], axis[0]);
  for (Vectors& a : axis) a = without_less_than(0x1p-60f, a);
  // A comparison with a NaN is false, so that it is not orthonormal.
  Lanes16 error = Lanes16::all(BlockTree::axes_error);
  Flags<16> orthonormal = abs(dot(axis[0], axis[1])) < error;
  for (int i = 0; i < 3; ++i) {
    orthonormal = orthonormal & (abs(dot(axis[i], axis[i]) - one) < error);
    orthonormal = orthonormal & (abs(dot(axis[i], axis[(i + 1) % 3])) < error);
  }
  Vectors space[3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  for (int i = 0; i < 3; ++i) axis[i] = select(orthonormal, axis[i], space[i]);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
