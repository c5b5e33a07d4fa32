#pragma once
#include <catena/core/hierarchy/sphere_bounds_visitor.h>
#include <catena/core/strategy/registry.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

/// Every node of a tree and every pair, as one number.
class Bits {
 public:
  void node(std::uint32_t id, const catena::Sphere64& bound) { nodes_[id] = bound; }
  void pairs(std::vector<catena::Pair> found) {
    std::ranges::sort(found);
    pairs_ = std::move(found);
  }
  std::uint64_t hash() const {
    std::uint64_t h = 0xcbf29ce484222325;
    const auto add = [&](std::uint64_t value) { h = (h ^ value) * 0x9e3779b97f4a7c15, h ^= h >> 32; };
    for (const auto& [id, s] : nodes_) {
      add(id);
      for (const double number : {s.x, s.y, s.z, s.radius}) add(std::bit_cast<std::uint64_t>(number));
    }
    for (const catena::Pair& p : pairs_) add(std::uint64_t{p.i} << 32 | p.j);
    return h;
  }
  std::size_t nodes() const { return nodes_.size(); }
  std::size_t pairs() const { return pairs_.size(); }

 private:
  std::map<std::uint32_t, catena::Sphere64> nodes_;
  std::vector<catena::Pair> pairs_;
};

/// A tangle of 1,000 spheres whose radii are about `scale`: 1, or where binary32 cannot square it.
inline catena::Chain tangle(float scale) {
  std::mt19937 random(1);
  const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  std::vector<catena::Sphere> spheres;
  for (int i = 0; i < 1000; ++i)
    spheres.push_back(
        {20 * unit() * scale, 20 * unit() * scale, 20 * unit() * scale, (0.25f + unit()) * scale});
  return catena::Chain(std::move(spheres));
}

/// What a variant of the library makes of a chain.
inline Bits bits_of(const std::string& variant, const catena::Chain& chain) {
  class Nodes final : public catena::SphereBoundsVisitor {
   public:
    explicit Nodes(Bits& to) : to_(to) {}
    void sphere(std::uint32_t id, const catena::Sphere64& parent, std::uint32_t,
                const catena::Sphere64&) override {
      to_.node(id, parent);
    }

   private:
    Bits& to_;
  };
  const auto search = catena::StrategyRegistry::instance().make(variant);
  catena::Collisions found;
  search->build(chain);
  search->find(chain, {}, found);
  Bits bits;
  Nodes nodes(bits);
  search->visit_bounds(nodes);
  bits.pairs(std::move(found.pairs));
  return bits;
}
