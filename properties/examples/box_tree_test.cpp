#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/register.h"
#include "catena/properties/testing/certified.h"

// A strategy with a tree of its own in one file: eight children a node, boxes in binary32, eight spheres a
// leaf block. Registered in the test program, so that every property meets it.
namespace catena {
namespace example {

struct Box32 {
  float low[3], high[3];
};

/// Level 0 has a box for every 8 consecutive spheres, level k + 1 one for every 8 of level k; the last level
/// is the root.
struct BoxTree {
  static constexpr std::uint32_t arity = 8;
  const Box32* box;            ///< level after level
  const std::uint32_t* first;  ///< of each level, its first box; then the number of all
  std::uint32_t spheres, levels;
  std::uint32_t height;  ///< levels and the spheres below them

  std::uint32_t size(std::uint32_t level) const { return first[level + 1] - first[level]; }
  std::uint32_t below(std::uint32_t level) const { return level == 0 ? spheres : size(level - 1); }
  std::uint32_t id(std::uint32_t level, std::uint32_t k) const { return spheres + first[level] + k; }
  const Box32& at(std::uint32_t level, std::uint32_t k) const { return box[first[level] + k]; }
};

void show_bounds(const BoxTree& tree, BoundsVisitor& visitor) {
  const auto shown = [&](std::uint32_t level, std::uint32_t k) {
    const Box32& b = tree.at(level, k);
    return Box64{{b.low[0], b.low[1], b.low[2]}, {b.high[0], b.high[1], b.high[2]}};
  };
  visitor.tree({.levels = tree.height});
  for (std::uint32_t level = 0; level < tree.levels; ++level)
    for (std::uint32_t c = 0; c < tree.below(level); ++c) {
      const std::uint32_t k = c / BoxTree::arity;
      if (level == 0)
        visitor.edge(tree.id(0, k), shown(0, k), c, Everything{});
      else
        visitor.edge(tree.id(level, k), shown(level, k), tree.id(level - 1, c), shown(level - 1, c));
    }
}

template <class Arithmetic>
class Boxes final : public Construction<BoxTree> {
 public:
  void build(const ChainView& chain) override {
    first_.assign(1, 0);
    for (std::uint32_t n = chain.size; n > 0 && (first_.size() == 1 || n > 1);) {
      n = (n + BoxTree::arity - 1) / BoxTree::arity;
      first_.push_back(first_.back() + n);
    }
    box_.resize(first_.back());
    if (chain.size > 0) refit(chain, {0, chain.size});
  }

  /// Only the boxes above what moved.
  void update(const ChainView& chain, const Moved& moved) override {
    if (moved.everything()) return build(chain);
    for (const SphereRange& range : moved.ranges()) refit(chain, range);
    spheres_ = chain.size;
  }

  BoxTree hierarchy() const override {
    const auto levels = static_cast<std::uint32_t>(first_.size() - 1);
    return {box_.data(), first_.data(), spheres_, levels, levels == 0 ? 0 : levels + 1};
  }

 private:
  void refit(const ChainView& chain, SphereRange range) {
    spheres_ = chain.size;
    const BoxTree tree = hierarchy();
    for (std::uint32_t level = 0; level < tree.levels; ++level) {
      range = {range.begin / BoxTree::arity, (range.end - 1) / BoxTree::arity + 1};
      for (std::uint32_t k = range.begin; k < range.end; ++k) {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        Box32 box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
        const std::uint32_t end = std::min(tree.below(level), (k + 1) * BoxTree::arity);
        for (std::uint32_t c = k * BoxTree::arity; c < end; ++c)
          join(box, level == 0 ? around(chain.spheres[c]) : tree.at(level - 1, c));
        box_[first_[level] + k] = box;
      }
    }
  }
  /// Rounded outward: one float further than the nearest one encloses.
  static Box32 around(const Sphere& s) {
    Box32 box;
    const float centre[] = {s.x, s.y, s.z};
    for (int a = 0; a < 3; ++a) {
      box.low[a] = std::nextafter(centre[a] - s.radius, -std::numeric_limits<float>::infinity());
      box.high[a] = std::nextafter(centre[a] + s.radius, std::numeric_limits<float>::infinity());
    }
    return box;
  }
  static void join(Box32& box, const Box32& other) {
    for (int a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], other.low[a]);
      box.high[a] = std::max(box.high[a], other.high[a]);
    }
  }

  std::vector<Box32> box_;
  std::vector<std::uint32_t> first_{0};
  std::uint32_t spheres_ = 0;
};

/// The tree against itself; each pair of spheres is met once.
template <class Arithmetic>
class BoxesAgainstBoxes final : public Traversal<BoxTree> {
 public:
  void find(const ChainView& chain, const BoxTree& tree, const Request& request,
            Collisions& result) override {
    search(chain, tree, request, result, nullptr);
  }
  Accounting evidence() const override { return Accounting::each_pair; }
  void find_with_evidence(const ChainView& chain, const BoxTree& tree, const Request& request,
                          Collisions& result, EvidenceSink& sink) override {
    search(chain, tree, request, result, &sink);
  }

 private:
  struct Search {
    const ChainView& chain;
    const BoxTree& tree;
    PairCollector::Lane& lane;
    EvidenceSink* sink;

    void within(std::uint32_t level, std::uint32_t k) const {
      const std::uint32_t begin = k * BoxTree::arity,
                          end = std::min(tree.below(level), begin + BoxTree::arity);
      for (std::uint32_t c = begin; c < end; ++c) {
        if (level > 0) within(level - 1, c);
        for (std::uint32_t d = c + 1; d < end; ++d) level > 0 ? between(level - 1, c, d) : spheres(c, d);
      }
    }
    void between(std::uint32_t level, std::uint32_t a, std::uint32_t b) const {
      if (lane.satisfied()) return;
      if (sink != nullptr) sink->compared(tree.id(level, a), tree.id(level, b));
      if (apart(tree.at(level, a), tree.at(level, b))) {
        if (sink != nullptr) sink->discarded(tree.id(level, a), tree.id(level, b));
        return;
      }
      const auto end = [&](std::uint32_t k) { return std::min(tree.below(level), (k + 1) * BoxTree::arity); };
      for (std::uint32_t c = a * BoxTree::arity; c < end(a); ++c)
        for (std::uint32_t d = b * BoxTree::arity; d < end(b); ++d)
          level > 0 ? between(level - 1, c, d) : spheres(c, d);
    }
    void spheres(std::uint32_t i, std::uint32_t j) const {
      const bool neighbours = chain.neighbours(i, j);
      if (sink != nullptr) neighbours ? sink->excluded(i, j) : sink->tested(i, j);
      if (!neighbours && Arithmetic::overlap(chain.spheres[i], chain.spheres[j])) lane.collide(i, j);
    }
    static bool apart(const Box32& a, const Box32& b) {
      for (int k = 0; k < 3; ++k)
        if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return true;
      return false;
    }
  };

  static void search(const ChainView& chain, const BoxTree& tree, const Request& request, Collisions& result,
                     EvidenceSink* sink) {
    PairCollector collector(chain.size, request, result);
    if (tree.levels > 0) Search{chain, tree, collector.lane(0), sink}.within(tree.levels - 1, 0);
    collector.finish();
  }
};

const RegisterConstruction<Boxes, Robust> boxes{
    {.name = "Boxes", .summary = "boxes of eight", .promises = {.same_bits = true}}};
const RegisterTraversal<BoxesAgainstBoxes, Robust> boxes_against_boxes{
    {.name = "BoxesAgainstBoxes", .summary = "boxes of eight against themselves"}};

TEST(BoxTreeExample, IsListedOnceAndMatchesNoTreeOfThePaper) {
  int with_boxes = 0;
  for (const VariantInfo& info : StrategyRegistry::instance().variants())
    for (const StageName& stage : info.parts.stages) with_boxes += stage.strategy.starts_with("Boxes");
  EXPECT_EQ(with_boxes, 2);
  EXPECT_THROW(StrategyRegistry::instance().describe("Boxes+CPU2"), InputError);
}

TEST(BoxTreeExample, IsCertified) { properties::expect_certified("Boxes+BoxesAgainstBoxes"); }

}  // namespace example
}  // namespace catena
