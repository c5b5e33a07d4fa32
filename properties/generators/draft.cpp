#include "catena/properties/generators/draft.h"

#include <algorithm>
#include <cmath>

namespace catena::properties {

bool Draft::finite() const {
  return std::ranges::all_of(spheres, [](const Sphere& s) {
    return std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.radius) &&
           s.radius >= 0;
  });
}

void Draft::remove(std::uint32_t first, std::uint32_t count) {
  const std::uint32_t end = first + count;
  spheres.erase(spheres.begin() + first, spheres.begin() + end);
  if (!strands.first.empty()) {
    Strands kept{{0}, {}};
    for (std::size_t s = 0; s + 1 < strands.first.size(); ++s) {
      std::uint32_t last = strands.first[s + 1];
      if (last > first) last -= std::min(last, end) - first;
      if (last == kept.first.back()) continue;
      kept.first.push_back(last);
      kept.closed.push_back(strands.closed.empty() ? 0 : strands.closed[s]);
    }
    if (kept.closed.empty()) kept = {};
    strands = std::move(kept);
  }
  std::vector<Pair> pairs;
  for (const Pair& p : exclusion.extra_pairs) {
    if ((p.i >= first && p.i < end) || (p.j >= first && p.j < end)) continue;
    pairs.push_back({p.i < first ? p.i : p.i - count, p.j < first ? p.j : p.j - count});
  }
  exclusion.extra_pairs = std::move(pairs);
}

void Draft::cut(std::uint32_t at) {
  auto& [first, closed] = strands;
  if (first.empty()) first = {0, size()};
  closed.resize(first.size() - 1, 0);
  const auto next = std::ranges::lower_bound(first, at);
  if (next == first.end() || *next == at) return;
  const auto strand = next - first.begin() - 1;
  first.insert(next, at);
  closed[static_cast<std::size_t>(strand)] = 0;
  closed.insert(closed.begin() + strand, 0);
}

void Draft::repeat(std::uint32_t at) {
  spheres.insert(spheres.begin() + at, spheres[at]);
  for (std::uint32_t& offset : strands.first)
    if (offset > at) ++offset;
  for (Pair& p : exclusion.extra_pairs) p.i += p.i > at, p.j += p.j > at;
}

}  // namespace catena::properties
