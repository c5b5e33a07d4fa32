#include "catena/bench/enumerate/enumerate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "catena/core/error.h"

namespace catena::bench {
namespace {

constexpr std::size_t walks_at_once = 4096;  ///< prolonged together, in one or two chains that fit a cache

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

class Enumeration {
 public:
  Enumeration(Variant& variant, const WalkQuestion& question) : variant_(variant), question_(question) {
    for (int n = 1; n <= question.steps; ++n) counts_.push_back({.steps = n});
  }

  std::vector<WalkCount> run() && {
    const Walk start;
    prolong({&start, 1});
    return std::move(counts_);
  }

 private:
  /// Depth first in blocks, so that no length is ever in memory as a whole.
  void prolong(std::span<const Walk> walks) {
    const std::vector<Walk> longer = free_extensions(walks);
    if (longer.empty()) return;
    count(longer);
    if (longer.front().length == question_.steps) return;
    for (std::size_t begin = 0; begin < longer.size(); begin += walks_at_once)
      prolong(std::span(longer).subspan(begin, std::min(walks_at_once, longer.size() - begin)));
  }

  std::vector<Walk> free_extensions(std::span<const Walk> walks) {
    std::vector<Walk> longer;
    for (const Walk& walk : walks)
      for_each_extension(walk, question_.dimensions, [&](const Walk& one) { longer.push_back(one); });
    const auto collisions = collisions_of_strands(variant_, chain_of_walks(longer, question_.radius), found_);
    std::size_t kept = 0;
    for (std::size_t w = 0; w < longer.size(); ++w)
      if (collisions[w] == 0) longer[kept++] = longer[w];
    longer.resize(kept);
    return longer;
  }

  void count(const std::vector<Walk>& walks) {
    WalkCount& counted = counts_[walks.front().length - 1u];
    for (const Walk& walk : walks) counted.walks += walk.images(question_.dimensions);
    if (!question_.contacts) return;
    const auto ends = collisions_of_strands(variant_, chain_of_walks(walks, 0.5f), found_);  // two a contact
    for (std::size_t w = 0; w < walks.size(); ++w)
      counted.contacts += ends[w] / 2 * walks[w].images(question_.dimensions);
  }

  Variant& variant_;
  const WalkQuestion question_;
  std::vector<WalkCount> counts_;
  Collisions found_;
};

}  // namespace

std::optional<WalkTable> WalkQuestion::table() const {
  if (radius < 0.5f) return WalkTable::self_avoiding;
  if (2 * double{radius} * radius < 1) return WalkTable::contact_free;  // (2r)^2 < 2, exactly
  return std::nullopt;
}

Chain chain_of_walks(const std::vector<Walk>& walks, float radius) {
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

std::vector<WalkCount> enumerate_walks(Variant& variant, const WalkQuestion& question) {
  if (question.steps < 1 || question.steps > Walk::most_steps)
    throw InputError(fmt::format("walks have 1 to {} steps, not {}", Walk::most_steps, question.steps));
  if (!(question.radius >= 0 && question.radius <= 100))
    throw InputError(fmt::format("the radius of a walk is 0 to 100 steps, not {}", question.radius));
  return Enumeration(variant, question).run();
}

}  // namespace catena::bench
