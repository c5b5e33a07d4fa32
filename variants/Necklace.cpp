#include <algorithm>
#include <span>
#include <vector>

#include "catena/core/executor/host_search.h"
#include "catena/core/hierarchy/enclosing_ball.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// The sphere hierarchies of Agarwal, Guibas, Nguyen, Russel and Zhang (Collision detection for deforming
/// necklaces, 2004): a balanced binary tree in chain order, searched against itself. Wrapped, each node is
/// the smallest ball about its leaves; nested, about the balls of its two children, as in the paper's trees.
/// They prove O(n^(4/3)) pairs of nodes for the wrapped one where spheres do not overlap too deeply.
template <class Arithmetic>
class Necklace final : public HostSearch {
 public:
  explicit Necklace(const Parameters& parameters)
      : wrapped_(parameters.choice("balls", {"wrapped", "nested"}) == "wrapped") {}

  Accounting evidence() const override { return Accounting::each_pair; }

  void visit_bounds(BoundsVisitor& visitor) const override {
    const auto n = built() ? static_cast<std::uint32_t>(balls_.size()) : 0;
    visitor.tree({.nested = !wrapped_});
    if (n > 1) show(visitor, {0, n}, n);
  }

 private:
  /// Spheres begin .. end - 1. The ball of an inner node is kept at its middle, which no other node has.
  struct Node {
    std::uint32_t begin, end;
    bool is_leaf() const { return end - begin == 1; }
    std::uint32_t middle() const { return begin + (end - begin) / 2; }
    Node left() const { return {begin, middle()}; }
    Node right() const { return {middle(), end}; }
    std::uint32_t id(std::uint32_t n) const { return is_leaf() ? begin : n + middle(); }
  };

  void construct(const ChainView& chain) override {
    balls_.resize(chain.size);
    if (chain.size > 0) make({chain.spheres, chain.size}, {0, chain.size});
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    search(chain, collector.lane(0), NoEvidence{});
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    search<EvidenceSink&>(chain, lane, sink);
  }

  Sphere make(std::span<const Sphere> spheres, const Node& node) {
    if (node.is_leaf()) return spheres[node.begin];
    const Sphere left = make(spheres, node.left()), right = make(spheres, node.right());
    const bool pair = node.end - node.begin == 2;
    return balls_[node.middle()] = wrapped_ && !pair
                                       ? enclosing_ball(spheres.subspan(node.begin, node.end - node.begin))
                                       : Arithmetic::parent(left, right);
  }

  void show(BoundsVisitor& visitor, const Node& node, std::uint32_t n) const {
    for (const Node& child : {node.left(), node.right()}) {
      if (child.is_leaf())
        visitor.edge(node.id(n), shown(balls_[node.middle()]), child.id(n), Everything{});
      else
        visitor.edge(node.id(n), shown(balls_[node.middle()]), child.id(n), shown(balls_[child.middle()]));
      if (!child.is_leaf()) show(visitor, child, n);
    }
  }
  static Sphere64 shown(const Sphere& s) { return {s.x, s.y, s.z, s.radius}; }

  template <class Sink>
  struct Search {
    const ChainView chain;
    std::span<const Sphere> balls;
    PairCollector::Lane& lane;
    Sink sink;

    const Sphere& ball(const Node& node) const {
      return node.is_leaf() ? chain.spheres[node.begin] : balls[node.middle()];
    }

    /// All pairs of spheres below one node.
    void within(const Node& node) {
      if (node.is_leaf() || lane.satisfied()) return;
      within(node.left());
      within(node.right());
      between(node.left(), node.right());
    }

    /// All pairs of a sphere below a with a sphere below b, which comes later in the chain.
    void between(const Node& a, const Node& b) {
      if (lane.satisfied()) return;
      if (a.is_leaf() && b.is_leaf()) return spheres(a.begin, b.begin);
      sink.compared(a.id(chain.size), b.id(chain.size));
      if (!Arithmetic::may_overlap(ball(a), ball(b)))
        return sink.discarded(a.id(chain.size), b.id(chain.size));
      if (b.is_leaf() || (!a.is_leaf() && ball(a).radius >= ball(b).radius)) {
        between(a.left(), b);
        between(a.right(), b);
      } else {
        between(a, b.left());
        between(a, b.right());
      }
    }

    void spheres(std::uint32_t i, std::uint32_t j) {
      if (chain.neighbours(i, j)) return sink.excluded(i, j);
      sink.tested(i, j);
      if (Arithmetic::overlap(chain.spheres[i], chain.spheres[j])) lane.collide(i, j);
    }
  };

  template <class Sink>
  void search(const ChainView& chain, PairCollector::Lane& lane, Sink sink) const {
    Search<Sink> search{chain, balls_, lane, sink};
    if (chain.size > 0) search.within({0, chain.size});
  }

  const bool wrapped_;
  std::vector<Sphere> balls_;
};

const RegisterVariant<Necklace, Robust> registered{
    {.name = "Necklace",
     .summary = "balls about runs of the chain, smallest about their spheres, against themselves, sequential",
     .parameters = {{"balls", "wrapped",
                     "wrapped: smallest about a node's spheres; nested: about its two children"}},
     .has_tree = true,
     .promises = {.same_bits = true, .same_order = true}}};

}  // namespace
}  // namespace catena
