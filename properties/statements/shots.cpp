#include "catena/properties/statements/shots.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <utility>

#include "catena/properties/sorted_pairs.h"
#include "catena/properties/statements/moved_frame.h"

namespace catena::properties {

std::vector<Shot> shots_of(const Chain& chain, const std::function<Case(Chain)>& solve) {
  std::vector<Shot> shots;
  const auto add = [&](const Chain& shot, int film, std::optional<std::int64_t> along = std::nullopt) {
    shots.push_back({solve(shot), film, along});
  };
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  add(chain, 0, 0);
  add(partly_moved_frame(chain).first, 0);
  add(shaken_frame(chain), 0);
  add(thinned_frame(chain), 0);
  if (spheres.size() > 2) {
    std::rotate(spheres.begin(), spheres.begin() + 2, spheres.end());
    add(chain.moved(spheres), 0, 2);
  }
  spheres.resize((spheres.size() + 1) / 2);
  const Chain shorter(std::move(spheres));
  add(shorter, 1);
  add(moved_frame(shorter), 1);
  add(Chain(), 2);
  return shots;
}

std::uint64_t seed_of(const Chain& chain) {
  std::uint64_t seed = chain.size();
  for (const Sphere& s : chain.spheres())
    for (const float x : {s.x, s.y, s.z, s.radius})
      seed = (seed ^ std::bit_cast<std::uint32_t>(x)) * 0x100000001B3u;
  return seed;
}

std::vector<SphereRange> changes(const Chain& from, const Chain& to, bool wider) {
  std::vector<SphereRange> ranges;
  const std::uint32_t n = to.size(), more = wider ? 1 : 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (std::memcmp(&from[i], &to[i], sizeof(Sphere)) == 0) continue;
    const SphereRange here{i - std::min(i, more), std::min(n, i + 1 + more)};
    if (!ranges.empty() && here.begin <= ranges.back().end)
      ranges.back().end = here.end;
    else
      ranges.push_back(here);
  }
  return ranges;
}

const char* word(Request::Want want) {
  return want == Request::Want::any ? "any" : want == Request::Want::counts ? "counts" : "pairs";
}

Expected expected(const Case& test, const SphereRange& queries) {
  Expected right{test.exact.count, {}};
  for (std::uint32_t i = 0; i < test.chain.size(); ++i)
    if (!queries.contains(i)) right.count[i] = 0;
  std::ranges::copy_if(test.exact.pairs, std::back_inserter(right.pairs),
                       [&](const Pair& p) { return queries.contains(p.i); });
  return right;
}

std::optional<std::string> fault_of(Collisions& found, Request::Want want, const Expected& right) {
  if (found.found != !right.pairs.empty())
    return fmt::format("found is {}, with {} pairs", found.found, right.pairs.size());
  if (want == Request::Want::any) return std::nullopt;
  if (found.pair_count != right.pairs.size())
    return fmt::format("{} pairs, exactly {}", found.pair_count, right.pairs.size());
  if (found.count != right.count) return "other counts";
  if (want == Request::Want::counts)
    return found.pairs.empty() ? std::nullopt : std::optional<std::string>("pairs that nobody asked for");
  sort(found.pairs);
  return found.pairs == right.pairs ? std::nullopt : std::optional<std::string>("other pairs");
}

}  // namespace catena::properties
