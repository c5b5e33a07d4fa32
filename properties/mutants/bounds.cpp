#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/properties/mutants/mutant.h"

// Bugs in the bounds of a tree.
namespace catena::properties {
namespace {

/// The radius that encloses, rounded to nearest and not up.
class OneUlpShort final : public FaultyTree {
  Sphere parent(const Sphere& a, const Sphere& b) const override {
    Sphere p = FaultyTree::parent(a, b);
    if (p == a || p == b || std::isinf(p.radius)) return p;
    const auto needed = [&](const Sphere& s) {
      return std::hypot(double{p.x} - s.x, double{p.y} - s.y, double{p.z} - s.z) + s.radius;
    };
    p.radius = std::nextafter(static_cast<float>(std::max(needed(a), needed(b))), 0.0f);
    return p;
  }
};
const RegisterMutant<OneUlpShort> ulp{"parent-one-ulp-short",
                                      "ipc-toolkit rounds its boxes outward; this one does not"};

/// The paper's parent in binary32 where it does not fail altogether.
class FarFromTheOrigin final : public FaultyTree {
  Sphere parent(const Sphere& a, const Sphere& b) const override {
    const Sphere p = Literal::parent(a, b);
    return std::isfinite(p.x + p.y + p.z + p.radius) ? p : FaultyTree::parent(a, b);
  }
};
const RegisterMutant<FarFromTheOrigin> far{"far-from-the-origin",
                                           "three-mesh-bvh#112: bounds lose what they hold"};

/// Two equal spheres at one place: 0/0 (the paper's second flaw). Comparisons with NaN are false.
class NanParent final : public FaultyTree {
  Sphere parent(const Sphere& a, const Sphere& b) const override {
    const bool same = a.x == b.x && a.y == b.y && a.z == b.z && a.radius == b.radius;
    return same ? Sphere{NAN, NAN, NAN, a.radius} : FaultyTree::parent(a, b);
  }
  bool descend(const Sphere& query, const Sphere& node) const override {
    return !std::isnan(node.x) && FaultyTree::descend(query, node);
  }
};
const RegisterMutant<NanParent> nan{"nan-parent-swallowed",
                                    "equal spheres at one place: 0/0, and NaN overlaps nothing"};

/// The children that touch the node from inside are called outside.
class StrictDescent final : public FaultyTree {
  bool descend(const Sphere& query, const Sphere& node) const override {
    const float dx = node.x - query.x, dy = node.y - query.y, dz = node.z - query.z;
    const float reach = query.radius + node.radius;
    return dx * dx + dy * dy + dz * dz < reach * reach;
  }
};
const RegisterMutant<StrictDescent> strict{"strict-descent", "libigl#2381: `<` where a node is skipped"};

/// Bounds that are only as good as when they were built.
class StaleBounds : public FaultyTree {
  void update(const Chain& chain, const Moved&) override {
    if (chain.size() != tree().leaves) return build(chain);
    std::ranges::copy(chain.spheres(), tree().bound);
  }
};
const RegisterMutant<StaleBounds> stale{"stale-bounds-after-update", "fcl#386: a stale AABB ruins culling"};

class RadiusChangeUnnoticed final : public FaultyTree {
  void update(const Chain& moved, const Moved&) override {
    const auto still = [](const Sphere& p, const Sphere& q) {
      return p.x == q.x && p.y == q.y && p.z == q.z;
    };
    if (moved.size() != tree().leaves || !std::ranges::equal(moved.spheres(), leaves(), still)) build(moved);
  }
  std::span<const Sphere> leaves() const { return {tree().bound, tree().leaves}; }
};
const RegisterMutant<RadiusChangeUnnoticed> radius{"radius-change-unnoticed",
                                                   "a frame that only swells counts as still"};

class FirstSphereStill final : public FaultyTree {
  void update(const Chain& moved, const Moved&) override {
    if (moved.size() != tree().leaves || moved.size() == 0 || moved[0] != tree().bound[0]) build(moved);
  }
};
const RegisterMutant<FirstSphereStill> first{"still-by-its-first-sphere",
                                             "nothing moved where the first sphere did not"};

/// Right, but every frame has buffers of its own.
class FreshBuffers final : public FaultyTree {
  void update(const Chain& moved, const Moved&) override {
    const std::vector<Sphere> frame(moved.spheres().begin(), moved.spheres().end());
    build(moved.moved(frame));
  }
};
const RegisterMutant<FreshBuffers> fresh{
    "buffers-anew-each-frame", "culbvh leaves its allocations out of the figure", {}, Fault::allocation};

}  // namespace
}  // namespace catena::properties
