#include "catena/bench/enumerate/enumerate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "catena/core/error.h"

namespace catena::bench {
namespace {

constexpr std::size_t walks_at_once = 4096;  ///< prolonged together, in one or two chains that fit a cache

template <class One>
Chain chain_of(const std::vector<One>& walks, float radius) {
  if (walks.empty()) return Chain();
  const int length = walks.front().length;
  // Strands lie in the cells of a cube; a walk stays within `length` steps of the middle of its own.
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(walks.size()))));
  const int pitch = 2 * length + 2 * static_cast<int>(std::ceil(radius)) + 1;
  std::vector<Sphere> spheres;
  spheres.reserve(walks.size() * (static_cast<std::size_t>(length) + 1));
  Strands strands{{0}, {}};
  for (std::size_t w = 0; w < walks.size(); ++w) {
    const std::array<std::size_t, 3> cell{w % side, w / side % side, w / side / side};
    for (const auto& p : walks[w].points()) {
      const auto at = [&](std::size_t axis) {
        return static_cast<float>(pitch * static_cast<int>(cell[axis]) + p[axis]);
      };
      spheres.push_back({at(0), at(1), at(2), radius});
    }
    strands.first.push_back(static_cast<std::uint32_t>(spheres.size()));
  }
  return Chain(std::move(spheres), std::move(strands));
}

/// The number of collisions of each strand of the chain.
std::vector<std::uint64_t> collisions_of_strands(Variant& variant, const Chain& chain, Collisions& found) {
  const Request counts{.want = Request::Want::counts};
  variant.prepare(counts);
  variant.build(chain);
  variant.find(chain, counts, found);
  const auto& first = chain.strands().first;
  std::vector<std::uint64_t> collisions(chain.strand_count());
  for (std::size_t s = 0; s < collisions.size(); ++s)
    for (std::uint32_t i = first[s]; i < first[s + 1]; ++i) collisions[s] += found.count[i];
  return collisions;
}

/// The walks of a question by classes: the first, those that are one step longer, and how many are alike.
struct CubicWalks {
  using One = Walk;
  int dimensions;

  One start() const { return {}; }
  template <class Visit>
  void extend(const One& walk, const Visit& visit) const {
    for_each_extension(walk, dimensions, visit);
  }
  std::uint64_t images(const One& walk) const { return walk.images(dimensions); }
};
struct OtherWalks {
  using One = OtherWalk;
  const OtherLattice* lattice;

  One start() const { return {lattice}; }
  template <class Visit>
  void extend(const One& walk, const Visit& visit) const {
    const int ways = walk.length == 0 ? 1 : static_cast<int>(lattice->steps.size());
    for (int step = 0; step < ways; ++step) visit(walk.then(step));
  }
  std::uint64_t images(const One& walk) const { return walk.images(); }
};

template <class Walks>
class Enumeration {
  using One = typename Walks::One;

 public:
  Enumeration(const Walks& walks, Variant& variant, const WalkQuestion& question)
      : walks_(walks), variant_(variant), question_(question) {
    for (int n = 1; n <= question.steps; ++n) counts_.push_back({.steps = n});
  }

  std::vector<WalkCount> run() && {
    const One start = walks_.start();
    prolong({&start, 1});
    return std::move(counts_);
  }

 private:
  /// Depth first in blocks, so that no length is ever in memory as a whole.
  void prolong(std::span<const One> walks) {
    const std::vector<One> longer = free_extensions(walks);
    if (longer.empty()) return;
    count(longer);
    if (longer.front().length == question_.steps) return;
    for (std::size_t begin = 0; begin < longer.size(); begin += walks_at_once)
      prolong(std::span(longer).subspan(begin, std::min(walks_at_once, longer.size() - begin)));
  }

  std::vector<One> free_extensions(std::span<const One> walks) {
    std::vector<One> longer;
    for (const One& walk : walks) walks_.extend(walk, [&](const One& one) { longer.push_back(one); });
    const auto collisions = collisions_of_strands(variant_, chain_of_walks(longer, question_.radius), found_);
    std::size_t kept = 0;
    for (std::size_t w = 0; w < longer.size(); ++w)
      if (collisions[w] == 0) longer[kept++] = longer[w];
    longer.resize(kept);
    return longer;
  }

  void count(const std::vector<One>& walks) {
    WalkCount& counted = counts_[walks.front().length - 1u];
    for (const One& walk : walks) counted.walks += walks_.images(walk);
    if (!question_.contacts) return;
    const auto ends = collisions_of_strands(variant_, chain_of_walks(walks, 0.5f), found_);  // two a contact
    for (std::size_t w = 0; w < walks.size(); ++w) counted.contacts += ends[w] / 2 * walks_.images(walks[w]);
  }

  const Walks walks_;
  Variant& variant_;
  const WalkQuestion question_;
  std::vector<WalkCount> counts_;
  Collisions found_;
};

}  // namespace

std::optional<WalkTable> WalkQuestion::table() const {
  if (radius < 0.5f) return WalkTable::self_avoiding;
  if (other) return std::nullopt;
  if (2 * double{radius} * radius < 1) return WalkTable::contact_free;  // (2r)^2 < 2, exactly
  return std::nullopt;
}

Chain chain_of_walks(const std::vector<Walk>& walks, float radius) { return chain_of(walks, radius); }
Chain chain_of_walks(const std::vector<OtherWalk>& walks, float radius) {
  return chain_of(walks, walks.empty() ? radius : walks.front().lattice->in_coordinates(radius));
}

std::vector<WalkCount> enumerate_walks(Variant& variant, const WalkQuestion& question) {
  if (question.steps < 1 || question.steps > question.most_steps())
    throw InputError(fmt::format("walks have 1 to {} steps, not {}", question.most_steps(), question.steps));
  if (!(question.radius >= 0 && question.radius <= 100))
    throw InputError(fmt::format("the radius of a walk is 0 to 100 steps, not {}", question.radius));
  if (question.other && !question.other->isometric && question.radius >= 0.5f)
    throw InputError(
        fmt::format("on the {} lattice a radius must be below 1/2: its walks lie folded in space, where "
                    "points are nearer than in the plane",
                    question.other->name));
  if (question.other) return Enumeration(OtherWalks{question.other}, variant, question).run();
  return Enumeration(CubicWalks{question.dimensions}, variant, question).run();
}

}  // namespace catena::bench
