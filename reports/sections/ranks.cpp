#include "catena/bench/ranks/scaling.h"
#include "catena/core/input/input.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// What ranks take of a search and have to tell one another, as threads of this process: times where they are few, and
/// what is counted, which needs no cores of their own, up to thousands of them.
nlohmann::ordered_json ranks(const Profile& profile) {
  constexpr const char* variant = "Hybrid";
  auto chains = nlohmann::ordered_json::array();
  for (const Profile::RankChain& asked : profile.rank_chains) {
    const Chain chain = open_input(asked.input, {}).animation->frame(0);
    std::vector<unsigned> few{1};
    for (const unsigned ranks : catena::ranks::doubled_ranks(profile.timed_ranks)) few.push_back(ranks);
    auto line = catena::ranks::to_json(
        catena::ranks::measure_scaling(chain, {.ranks = few, .timed_variant = variant}));
    const auto counted = catena::ranks::to_json(catena::ranks::measure_scaling(chain, {.ranks = asked.counted}));
    for (const auto& point : counted["points"]) line["points"].push_back(point);
    chains.push_back({{"input", asked.input}, {"n", chain.size()}, {"points", line["points"]}});
  }
  if (chains.empty()) return {};
  return {{"searched_by", variant}, {"chains", std::move(chains)}};
}

const RegisterSection registered{"ranks", ranks};

}  // namespace
}  // namespace catena::reports
