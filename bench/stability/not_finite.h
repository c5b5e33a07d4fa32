#pragma once
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "catena/core/hierarchy/sphere_bounds_visitor.h"
#include "catena/core/strategy/variant.h"

namespace catena::bench {

/// Counts the nodes of a hierarchy that are no sphere: not-a-number in any place, or an infinite centre. An
/// infinite radius alone is an honest bound and not counted.
class NotFiniteNodes final : public SphereBoundsVisitor {
 public:
  void sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
              const Sphere64& child) override {
    if (!is_sphere(parent)) bad_.insert(parent_id);
    if (!is_sphere(child)) bad_.insert(child_id);
  }
  std::uint64_t count() const { return bad_.size(); }

  static bool is_sphere(const Sphere64& s) {
    return std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && !std::isnan(s.radius);
  }

 private:
  std::unordered_set<std::uint32_t> bad_;
};

}  // namespace catena::bench
