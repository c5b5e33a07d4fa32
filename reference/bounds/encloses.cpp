#include <algorithm>
#include <cmath>

#include "catena/reference/bounds.h"
#include "catena/reference/bounds/form.h"
#include "catena/reference/enclosure.h"

namespace catena::reference {
namespace {

bool finite(const Vector64& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// low <= inner.low and inner.high <= high in each coordinate.
bool box_in_box(const Box64& outer, const Box64& inner) {
  const auto at_most = [](const Vector64& a, const Vector64& b) {
    return a.x <= b.x && a.y <= b.y && a.z <= b.z;
  };
  return at_most(outer.low, inner.low) && at_most(inner.high, outer.high);
}

/// All bounds are convex, so a box is in one that contains its corners.
bool corners_in(const AnyBound& outer, const Box64& b) {
  if (!finite(b.low) || !finite(b.high)) return false;
  for (int corner = 0; corner < 8; ++corner) {
    const Sphere64 point{corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y,
                         corner & 4 ? b.high.z : b.low.z, 0};
    if (!contains(outer, point)) return false;
  }
  return true;
}

bool slabs_in_slabs(const Slabs64& outer, const Slabs64& inner) {
  return outer.origin == inner.origin && std::ranges::all_of(outer.slabs, [&](const Slab& o) {
           return std::ranges::any_of(inner.slabs, [&](const Slab& i) {
             return i.direction == o.direction && o.low <= i.low && i.high <= o.high;
           });
         });
}

/// Of proper bounds; the outer one is not everything.
struct InnerOf {
  const AnyBound& outer;
  bool operator()(const Everything&) const { return false; }
  bool operator()(const Sphere64& s) const { return contains(outer, s); }
  bool operator()(const Capsule64& c) const {
    return contains(outer, Sphere64{c.a.x, c.a.y, c.a.z, c.radius}) &&
           contains(outer, Sphere64{c.b.x, c.b.y, c.b.z, c.radius});
  }
  bool operator()(const Box64& b) const {
    const auto* box = std::get_if<Box64>(&outer);
    return box ? box_in_box(*box, b) : corners_in(outer, b);
  }
  bool operator()(const Slabs64& s) const {
    const auto* slabs = std::get_if<Slabs64>(&outer);
    return slabs && slabs_in_slabs(*slabs, s);
  }
};

}  // namespace

bool encloses(const AnyBound& outer, const AnyBound& inner) {
  if (!proper(outer) || !proper(inner)) return false;
  return is_everything(outer) || std::visit(InnerOf{outer}, inner);
}

}  // namespace catena::reference
