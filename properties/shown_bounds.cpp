#include "catena/properties/shown_bounds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

}  // namespace

class ShownBounds::Collector final : public BoundsVisitor {
 public:
  explicit Collector(std::vector<Edge>& edges) : edges_(edges) {}
  void edge(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id,
            const AnyBound& child) override {
    std::vector<double>& numbers = edges_.emplace_back(Edge{parent_id, child_id, {}}).numbers;
    for (const AnyBound* bound : {&parent, &child}) {
      numbers.push_back(static_cast<double>(bound->index()));
      std::visit(Numbers{numbers}, *bound);
    }
  }

 private:
  std::vector<Edge>& edges_;
};

ShownBounds::ShownBounds(const Variant& variant) {
  Collector collector(edges_);
  variant.visit_bounds(collector);
  sort();
}

ShownBounds ShownBounds::of_evidence(const Variant& variant, const Chain& chain) {
  ShownBounds shown;
  Collector collector(shown.edges_);
  visit_evidence_nodes(variant, chain, collector);
  shown.sort();
  return shown;
}

void ShownBounds::sort() {
  std::ranges::sort(edges_, {}, [](const Edge& edge) { return std::pair(edge.parent, edge.child); });
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> ShownBounds::edges() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ids;
  for (const Edge& edge : edges_) ids.push_back({edge.parent, edge.child});
  return ids;
}

std::optional<std::string> ShownBounds::difference(const ShownBounds& other) const {
  if (edges_.size() != other.edges_.size())
    return fmt::format("{} bounds below others instead of {}", other.edges_.size(), edges_.size());
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const Edge &a = edges_[k], &b = other.edges_[k];
    const bool same = std::ranges::equal(a.numbers, b.numbers,
                                         [](double p, double q) { return p == q || (p != p && q != q); });
    if (a.parent != b.parent || a.child != b.child || !same)
      return fmt::format("{} below {}: {:a}; {} below {}: {:a}", a.child, a.parent, fmt::join(a.numbers, " "),
                         b.child, b.parent, fmt::join(b.numbers, " "));
  }
  return {};
}

}  // namespace catena::properties
