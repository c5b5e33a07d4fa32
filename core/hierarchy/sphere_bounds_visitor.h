#pragma once
#include "catena/core/hierarchy/bounds_visitor.h"

namespace catena {

/// Receives a tree of spheres, such as the paper's; a (parent, child) of which one is no sphere is left out.
class SphereBoundsVisitor : public BoundsVisitor {
 public:
  virtual void sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
                      const Sphere64& child) = 0;

 private:
  void edge(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id, const AnyBound& child) final {
    const auto *p = std::get_if<Sphere64>(&parent), *c = std::get_if<Sphere64>(&child);
    if (p != nullptr && c != nullptr) sphere(parent_id, *p, child_id, *c);
  }
};

}  // namespace catena
