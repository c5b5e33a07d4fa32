#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "catena/core/executor/team.h"
#include "catena/core/parts/local_chain.h"
#include "catena/core/parts/part_search.h"
#include "catena/core/parts/partition.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/timings.h"
#include "catena/core/strategy/work_done.h"

namespace catena::parts {

/// Finds the collisions of a chain part after part, by several searches at a time, each in a thread of its
/// own. A part that has a search to itself is built once and stays there; others come and go with each find.
class PartedSearch {
 public:
  struct Options {
    Partition::Options partition;
    std::uint32_t parts = 1;       ///< wanted: fewer where they would be short, more where there is no room
    std::uint32_t least_part = 1;  ///< spheres that are worth a part
    std::uint64_t room = 1;        ///< most spheres of a part and its halo
    bool room_is_guessed = false;  ///< then it becomes smaller where a search says that it has no room
  };

  PartedSearch(std::vector<std::unique_ptr<PartSearch>> searches, const Options& options, const Team& team);

  /// Parts the chain; builds parts that stay. Throws CapacityError where a part has no room however small it
  /// is.
  void build(const Chain& chain, const Request& request);
  /// As Variant::find.
  void find(const Chain& chain, const Request& request, Collisions& result);
  Timings timings() const;
  std::vector<WorkDone> work() const;

 private:
  /// What a part found, in the numbers of the whole chain.
  struct Found {
    bool any = false;
    std::uint64_t pairs = 0;
    std::vector<Pair> list;
  };

  void part_chain(const Chain& chain);
  std::uint32_t more_parts(std::uint32_t parts, std::uint64_t greatest) const;
  bool stay() const { return parts_.size() <= searches_.size(); }
  void build_those_that_stay(const Chain& chain);
  void with_room(const Chain& chain, const std::function<void()>& work);
  void for_each_part(const std::function<void(std::uint32_t part, std::size_t by)>& work);
  void search_part(const Chain& chain, std::uint32_t part, std::size_t by, const Request& request,
                   Collisions& result);
  void take(const LocalChain& part, const Request& request, const Collisions& found, Found& to,
            Collisions& result) const;
  void gather(const Request& request, Collisions& result);
  double slowest(double Timings::*stage) const;

  std::vector<std::unique_ptr<PartSearch>> searches_;
  std::vector<Collisions> scratch_;  ///< of each
  std::vector<Timings> times_;       ///< of each, summed up
  Options options_;
  const Team& team_;
  Request prepared_;
  std::optional<Partition> partition_;
  std::vector<LocalChain> parts_;
  std::vector<Found> found_;              ///< of each part
  std::optional<std::uint32_t> spheres_;  ///< of the chain that was parted
  bool built_ = false;                    ///< all parts, and they stay
  double plan_ms_ = 0, moved_in_build_ms_ = 0, moved_in_find_ms_ = 0;
};

}  // namespace catena::parts
