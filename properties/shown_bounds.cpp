#include "catena/properties/shown_bounds.h"

#include <algorithm>

#include "catena/core/strategy/evidence_nodes.h"

namespace catena::properties {
namespace {

struct Numbers {
  std::vector<double>& to;
  void operator()(const Vector64& v) const { to.insert(to.end(), {v.x, v.y, v.z}); }
  void operator()(const Everything&) const {}
  void operator()(const Sphere64& s) const { to.insert(to.end(), {s.x, s.y, s.z, s.radius}); }
  void operator()(const Capsule64& c) const { (*this)(c.a), (*this)(c.b), to.push_back(c.radius); }
  void operator()(const Box64& b) const { (*this)(b.low), (*this)(b.high); }
  void operator()(const Slabs64& s) const {
    (*this)(s.origin);
    for (const Slab& slab : s.slabs) (*this)(slab.direction), to.insert(to.end(), {slab.low, slab.high});
  }
};

class Collector final : public BoundsVisitor {
 public:
  Collector(std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges, std::vector<double>& numbers)
      : edges_(edges), numbers_(numbers) {}
  void edge(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id,
            const AnyBound& child) override {
    edges_.push_back({parent_id, child_id});
    for (const AnyBound* bound : {&parent, &child}) {
      numbers_.push_back(static_cast<double>(bound->index()));
      std::visit(Numbers{numbers_}, *bound);
    }
  }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges_;
  std::vector<double>& numbers_;
};

}  // namespace

ShownBounds::ShownBounds(const Variant& variant) {
  Collector collector(edges_, numbers_);
  variant.visit_bounds(collector);
  std::ranges::sort(edges_);
}

ShownBounds ShownBounds::of_evidence(const Variant& variant) {
  ShownBounds shown;
  Collector collector(shown.edges_, shown.numbers_);
  visit_evidence_nodes(variant, collector);
  std::ranges::sort(shown.edges_);
  return shown;
}

bool ShownBounds::same_bits(const ShownBounds& other) const {
  return std::ranges::equal(numbers_, other.numbers_,
                            [](double p, double q) { return p == q || (p != p && q != q); });
}

}  // namespace catena::properties
