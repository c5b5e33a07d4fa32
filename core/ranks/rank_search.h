#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/strategy/request.h"
#include "catena/core/parts/order.h"
#include "catena/core/ranks/across.h"
#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/part.h"

namespace catena::ranks {

/// How the spheres are shared out for the search; in chain order: as the parts come.
using parts::Order;

/// The steps of a search, in their order.
enum class Phase { take_part, order, repartition, build, within, across, answers, done };
/// As reports name it.
std::string_view name_of(Phase phase);

/// How a search by ranks goes about it, the same on every rank.
struct RankOptions {
  std::string variant = "auto";  ///< that searches each part
  Order order = Order::measured;
  Request request{};                           ///< what is wanted, and the limit of pairs over all ranks
  std::uint32_t blocks_at_once = 0, meetings = AcrossOptions().meetings;  ///< see AcrossOptions
  /// Of pairs only those whose lower sphere is one of these are kept, and make `found` and `pair_count`; the
  /// collisions of each sphere are all.
  IdRange pairs_of{};
  bool across_only = false;  ///< only pairs of two ranks are searched for: to count what those take
  std::function<void(Phase)> entering = [](Phase) {};  ///< called as this rank comes to each phase
};

/// The part of the answer that is about the spheres which a rank began with.
struct RankAnswer {
  std::vector<SphereId> starts;      ///< of the ranks, and the number of all spheres
  SphereId first = 0;                ///< of this one
  std::vector<std::uint64_t> count;  ///< collisions of each; none for Want::any
  std::vector<IdPair> pairs;         ///< i < j, i of this rank, sorted; none past the limit
  bool found = false;                ///< on any rank
  std::uint64_t pair_count = 0;      ///< of all ranks
};

/// What a rank did for it.
struct RankWork {
  bool in_space = false;        ///< the spheres were parted by space
  double touching_share = 0;    ///< in chain order: see touching_share; 0 when the order was told
  std::uint64_t spheres = 0;    ///< that this rank searched
  std::uint64_t blocks = 0;
  std::uint64_t pairs_within = 0, pairs_across = 0;  ///< that it found
  AcrossWork across;
};

/// Finds what collides in a chain whose parts are those of the ranks, in their order: rank 0 has the first
/// spheres. Parts may be uneven or empty. All ranks call it with the same options. More pairs than the
/// request's limit leave every rank without pairs; the caller compares pair_count. Throws RankFailed on all
/// ranks when one throws.
RankAnswer search(Communicator& ranks, Part part, const RankOptions& options, RankWork& work);

}  // namespace catena::ranks
