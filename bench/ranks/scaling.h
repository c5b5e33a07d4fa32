#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/growth/growth.h"
#include "catena/core/chain/chain.h"
#include "catena/core/ranks/phase_clock.h"

namespace catena::ranks {

/// What the exchange takes at one number of ranks: counted, not timed, and so the same in every run.
struct ScalingPoint {
  unsigned ranks = 0;
  bool in_space = false;
  std::uint64_t blocks = 0;         ///< of all ranks
  std::uint64_t most_spheres = 0;   ///< of a rank
  std::uint64_t most_partners = 0;  ///< ranks that one asks
  std::uint64_t most_rounds = 0;
  std::uint64_t blocks_told = 0;      ///< that ranks were told of, all together
  std::uint64_t blocks_asked = 0;     ///< likewise
  std::uint64_t blocks_touching = 0;  ///< likewise: no exchange can do with fewer
  std::uint64_t most_blocks_asked = 0;
  std::uint64_t bytes = 0, most_bytes = 0, messages = 0, most_messages = 0;
  std::uint64_t pairs_across = 0,
                pairs = 0;  ///< of those found, all; those across alone where nothing is timed
  /// Processor time of each phase, of all ranks together and of the rank that took most; where times were
  /// asked for.
  PhaseClock::Milliseconds all_ms{}, most_ms{};
};

struct ScalingOptions {
  std::vector<unsigned> ranks;  ///< each at least 1
  Order order = Order::measured;
  /// Searches the parts, too, by this variant, and tells what each phase takes; empty: only what is exchanged
  /// is counted.
  std::string timed_variant{};
};

/// A chain shared out over ever more ranks.
struct Scaling {
  std::vector<ScalingPoint> points;
  bool timed = false;

  /// Blocks that a rank asks for ~ (blocks that it holds)^exponent, over the points shared out by space: 2/3
  /// for a surface. None for fewer than four of them.
  std::optional<bench::Growth::Law> surface() const;
  /// The fewest ranks of which one asks for more blocks than an even share: from there on more ranks exchange
  /// more than they search. 0: none of these.
  unsigned stops_at() const;
};

/// 2, 4, 8, ... up to `most`.
std::vector<unsigned> doubled_ranks(unsigned most);

/// Runs the sharing out and the exchange, and not the search within the parts unless times are asked for, on
/// each of these numbers of ranks, which are threads of this process.
Scaling measure_scaling(const Chain& chain, const ScalingOptions& options);

nlohmann::ordered_json to_json(const Scaling& scaling);

}  // namespace catena::ranks
