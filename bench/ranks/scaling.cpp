#include "catena/bench/ranks/scaling.h"

#include <algorithm>

#include "catena/core/ranks/thread_ranks.h"

namespace catena::ranks {
namespace {

ScalingPoint measure(const Chain& chain, unsigned ranks, Order order) {
  std::vector<RankWork> work(ranks);
  std::vector<Traffic> traffic(ranks);
  const RankOptions options{.order = order, .request = {.want = Request::Want::counts}, .across_only = true};
  run_in_threads(ranks, [&](Communicator& communicator) {
    const unsigned rank = communicator.rank();
    const auto start = [&](unsigned r) {
      return static_cast<std::uint32_t>(even_start(chain.size(), ranks, r));
    };
    search(communicator, part_of(chain, start(rank), start(rank + 1)), options, work[rank]);
    traffic[rank] = communicator.traffic();
  });
  ScalingPoint point{.ranks = ranks, .in_space = work[0].in_space};
  for (unsigned rank = 0; rank < ranks; ++rank) {
    const AcrossWork& across = work[rank].across;
    point.blocks += work[rank].blocks;
    point.most_spheres = std::max(point.most_spheres, work[rank].spheres);
    point.most_partners = std::max(point.most_partners, across.partners);
    point.most_rounds = std::max(point.most_rounds, across.rounds);
    point.boxes_seen += across.boxes_seen;
    point.blocks_asked += across.blocks_asked;
    point.blocks_touching += across.blocks_touching;
    point.most_blocks_asked = std::max(point.most_blocks_asked, across.blocks_asked);
    point.bytes += traffic[rank].bytes;
    point.most_bytes = std::max(point.most_bytes, traffic[rank].bytes);
    point.messages += traffic[rank].messages;
    point.most_messages = std::max(point.most_messages, traffic[rank].messages);
    point.pairs_across += work[rank].pairs_across;
  }
  return point;
}

}  // namespace

std::optional<bench::Growth::Law> Scaling::surface() const {
  bench::Growth growth;
  for (const ScalingPoint& p : points)
    if (p.in_space && p.blocks_asked >= p.ranks)
      growth.points.push_back({static_cast<std::uint32_t>(p.blocks / p.ranks), p.blocks_asked / p.ranks});
  if (growth.points.size() < 4) return {};
  return growth.plain_power();
}

unsigned Scaling::stops_at() const {
  const auto first = std::ranges::find_if(
      points, [](const ScalingPoint& p) { return p.most_blocks_asked > p.blocks / p.ranks; });
  return first == points.end() ? 0 : first->ranks;
}

Scaling measure_scaling(const Chain& chain, unsigned most, Order order) {
  Scaling scaling;
  for (unsigned ranks = 2; ranks <= most; ranks *= 2) scaling.points.push_back(measure(chain, ranks, order));
  return scaling;
}

nlohmann::ordered_json to_json(const Scaling& scaling) {
  nlohmann::ordered_json json;
  json["points"] = nlohmann::ordered_json::array();
  for (const ScalingPoint& p : scaling.points)
    json["points"].push_back({{"ranks", p.ranks},
                              {"order", p.in_space ? "space" : "chain"},
                              {"blocks", p.blocks},
                              {"most_spheres", p.most_spheres},
                              {"most_partners", p.most_partners},
                              {"most_rounds", p.most_rounds},
                              {"boxes_seen", p.boxes_seen},
                              {"blocks_asked", p.blocks_asked},
                              {"blocks_touching", p.blocks_touching},
                              {"most_blocks_asked", p.most_blocks_asked},
                              {"bytes", p.bytes},
                              {"most_bytes", p.most_bytes},
                              {"messages", p.messages},
                              {"most_messages", p.most_messages},
                              {"pairs_across", p.pairs_across}});
  if (const auto law = scaling.surface())
    json["surface"] = {{"exponent", law->exponent}, {"low", law->low}, {"high", law->high}};
  json["stops_at"] = scaling.stops_at();
  return json;
}

}  // namespace catena::ranks
