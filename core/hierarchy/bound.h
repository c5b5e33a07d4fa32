#pragma once
#include <span>
#include <variant>

#include "catena/core/export.h"
#include "catena/core/sphere.h"

namespace catena {

/// A point or direction in binary64.
struct CATENA_API Vector64 {
  double x, y, z;
  friend bool operator==(const Vector64&, const Vector64&) = default;
};

/// No bound at all: every point is in it. What a node is shown with when the strategy stores none for it,
/// such as the root of a tree whose nodes hold the bounds of their children.
struct CATENA_API Everything {
  friend bool operator==(const Everything&, const Everything&) = default;
};

/// All points within `radius` of the segment from a to b; a == b is a sphere. radius >= 0, infinite:
/// everything.
struct CATENA_API Capsule64 {
  Vector64 a, b;
  double radius;
  friend bool operator==(const Capsule64&, const Capsule64&) = default;
};

/// All points p with low <= p <= high in each coordinate. Ends may be infinite.
struct CATENA_API Box64 {
  Vector64 low, high;
  friend bool operator==(const Box64&, const Box64&) = default;
};

/// The points whose product with a direction, of any length but 0, is between two numbers; see Slabs64.
struct CATENA_API Slab {
  Vector64 direction;
  double low, high;
  friend bool operator==(const Slab&, const Slab&) = default;
};

/// All points p with low <= direction . (p - origin) <= high for each slab: a k-DOP, or by three slabs an
/// oriented box. The ends are relative to the origin, so that a far origin costs no bits.
struct CATENA_API Slabs64 {
  Vector64 origin;
  std::span<const Slab> slabs;  ///< the strategy's own memory; valid while the bound is shown
};

/// The bound of one node as it is shown to a BoundsVisitor: the strategy's own binary32 (or binary64)
/// numbers, which convert exactly. What it promises is that every *sphere* below the node lies in it.
using AnyBound = std::variant<Everything, Sphere64, Capsule64, Box64, Slabs64>;

}  // namespace catena
