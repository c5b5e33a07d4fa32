#include <algorithm>

#include "catena/bench/ranks/scaling.h"
#include "catena/core/input/input.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

constexpr unsigned most_timed = 256;  // threads of more wake one another for longer than they work

/// So many ranks that a chain is shared out among, of those above `least` and up to `most`: doubled up to 64,
/// then four times as many each.
std::vector<unsigned> numbers_of_ranks(unsigned least, unsigned most) {
  std::vector<unsigned> all;
  for (unsigned ranks = 1; ranks <= most; ranks *= ranks < 64 ? 2 : 4)
    if (ranks > least) all.push_back(ranks);
  return all;
}

/// What ranks take of a search and have to tell one another, as threads of this process: the time that each
/// computed, and what is counted, need no cores of their own.
nlohmann::ordered_json ranks(const Profile& profile) {
  constexpr const char* variant = "Hybrid";
  auto chains = nlohmann::ordered_json::array();
  for (const auto& [input, most] : profile.rank_chains) {
    const Chain chain = open_input(input, {}).animation->frame(0);
    auto scaling = catena::ranks::measure_scaling(
        chain, {.ranks = numbers_of_ranks(0, std::min(most, most_timed)), .timed_variant = variant});
    auto points = catena::ranks::to_json(scaling)["points"];
    scaling = catena::ranks::measure_scaling(chain, {.ranks = numbers_of_ranks(most_timed, most)});
    const auto counted = catena::ranks::to_json(scaling);  // lives as long as the loop over what it holds
    for (const auto& point : counted["points"]) points.push_back(point);
    chains.push_back({{"input", input}, {"n", chain.size()}, {"points", std::move(points)}});
  }
  if (chains.empty()) return {};
  return {{"searched_by", variant}, {"chains", std::move(chains)}};
}

const RegisterSection registered{"ranks", ranks};

}  // namespace
}  // namespace catena::reports
