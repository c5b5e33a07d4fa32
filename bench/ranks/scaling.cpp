#include "catena/bench/ranks/scaling.h"

#include <algorithm>

#include "catena/core/ranks/thread_ranks.h"

namespace catena::ranks {
namespace {

ScalingPoint measure(const Chain& chain, unsigned ranks, const ScalingOptions& asked) {
  std::vector<RankWork> work(ranks);
  std::vector<Traffic> traffic(ranks);
  std::vector<PhaseClock> clocks(ranks);
  std::uint64_t pairs = 0;
  run_in_threads(ranks, [&](Communicator& communicator) {
    const unsigned rank = communicator.rank();
    RankOptions options{.order = asked.order, .request = {.want = Request::Want::counts}};
    if (asked.timed_variant.empty())
      options.across_only = true;
    else
      options.variant = asked.timed_variant;
    options.entering = [&clock = clocks[rank]](Phase phase) { clock.enter(phase); };
    const RankAnswer answer = search(communicator, even_part_of(chain, ranks, rank), options, work[rank]);
    traffic[rank] = communicator.traffic();
    if (rank == 0) pairs = answer.pair_count;
  });
  ScalingPoint point{.ranks = ranks, .in_space = work[0].in_space, .pairs = pairs};
  for (unsigned rank = 0; rank < ranks; ++rank) {
    const AcrossWork& across = work[rank].across;
    point.blocks += work[rank].blocks;
    point.most_spheres = std::max(point.most_spheres, work[rank].spheres);
    point.most_partners = std::max(point.most_partners, across.partners);
    point.most_rounds = std::max(point.most_rounds, across.rounds);
    point.blocks_told += across.blocks_told;
    point.blocks_asked += across.blocks_asked;
    point.blocks_touching += across.blocks_touching;
    point.most_blocks_asked = std::max(point.most_blocks_asked, across.blocks_asked);
    point.bytes += traffic[rank].bytes;
    point.most_bytes = std::max(point.most_bytes, traffic[rank].bytes);
    point.messages += traffic[rank].messages;
    point.most_messages = std::max(point.most_messages, traffic[rank].messages);
    point.pairs_across += work[rank].pairs_across;
    for (std::size_t k = 0; k < PhaseClock::phases; ++k) {
      const double ms = clocks[rank].processor_ms()[k];
      point.all_ms[k] += ms, point.most_ms[k] = std::max(point.most_ms[k], ms);
    }
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

std::vector<unsigned> doubled_ranks(unsigned most) {
  std::vector<unsigned> all;
  for (unsigned ranks = 2; ranks <= most; ranks *= 2) all.push_back(ranks);
  return all;
}

Scaling measure_scaling(const Chain& chain, const ScalingOptions& options) {
  Scaling scaling;
  scaling.timed = !options.timed_variant.empty();
  for (const unsigned ranks : options.ranks) scaling.points.push_back(measure(chain, ranks, options));
  return scaling;
}

namespace {

nlohmann::ordered_json phases_to_json(const PhaseClock::Milliseconds& ms) {
  nlohmann::ordered_json json;
  for (std::size_t k = 0; k + 1 < PhaseClock::phases; ++k) json[name_of(static_cast<Phase>(k))] = ms[k];
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const Scaling& scaling) {
  nlohmann::ordered_json json;
  json["points"] = nlohmann::ordered_json::array();
  for (const ScalingPoint& p : scaling.points) {
    json["points"].push_back({{"ranks", p.ranks},
                              {"order", p.in_space ? "space" : "chain"},
                              {"blocks", p.blocks},
                              {"most_spheres", p.most_spheres},
                              {"most_partners", p.most_partners},
                              {"most_rounds", p.most_rounds},
                              {"blocks_told", p.blocks_told},
                              {"blocks_asked", p.blocks_asked},
                              {"blocks_touching", p.blocks_touching},
                              {"most_blocks_asked", p.most_blocks_asked},
                              {"bytes", p.bytes},
                              {"most_bytes", p.most_bytes},
                              {"messages", p.messages},
                              {"most_messages", p.most_messages},
                              {"pairs_across", p.pairs_across}});
    if (!scaling.timed) continue;
    json["points"].back()["pairs"] = p.pairs;
    json["points"].back()["processor_ms"] = phases_to_json(p.all_ms);
    json["points"].back()["most_processor_ms"] = phases_to_json(p.most_ms);
  }
  if (const auto law = scaling.surface())
    json["surface"] = {{"exponent", law->exponent}, {"low", law->low}, {"high", law->high}};
  json["stops_at"] = scaling.stops_at();
  return json;
}

}  // namespace catena::ranks
