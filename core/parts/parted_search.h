#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
#include "catena/core/parts/local_chain.h"
#include "catena/core/parts/part_search.h"
#include "catena/core/parts/partition.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/timings.h"
#include "catena/core/strategy/work_done.h"

namespace catena::parts {

/// Finds the collisions of a chain part after part, by several searches at a time, each in a thread of its
/// own.
///
/// A part that has a search to itself is built once, with its halo, and stays there. Others come and go with
/// each find, and how the chain is parted then depends on what it is like. Where chain order does not tangle
/// the parts they come without halos, and the boxes of their groups are made as they are moved; the few
/// groups that then turn out to touch other parts are searched together, for pairs of two parts. So the chain
/// is read once. Else parts come with halos.
class PartedSearch {
 public:
  struct Options {
    PartitionOptions partition;
    std::uint32_t parts = 1;       ///< wanted: fewer where they would be short, more where there is no room
    std::uint32_t least_part = 1;  ///< spheres that are worth a part
    std::uint64_t room = 1;        ///< most spheres of a part and its halo
    bool room_is_guessed = false;  ///< then it becomes smaller where a search says that it has no room
  };

  PartedSearch(std::vector<std::unique_ptr<PartSearch>> searches, const Options& options, const Team& team);

  /// Builds parts that stay. Throws CapacityError where a part has no room however small it is.
  void build(const Chain& chain, const Request& request);
  /// As Variant::find.
  void find(const Chain& chain, const Request& request, Collisions& result);
  Timings timings() const;
  /// How the chain was shared out.
  Plan plan() const;
  std::vector<WorkDone> work() const;

 private:
  /// What a part found, in the numbers of the whole chain.
  struct Found {
    bool any = false;
    std::uint64_t pairs = 0;
    std::vector<Pair> list;  ///< its memory is kept from find to find
  };
  /// One search, and what it keeps.
  struct Worker {
    std::unique_ptr<PartSearch> search;
    Collisions found;
    std::vector<std::uint32_t> count;
    Timings times;  ///< summed up
  };

  void share_out(const Chain& chain);
  void part_with_halos(const Chain& chain);
  void set_parts(const Chain& chain, Partition partition);
  std::uint32_t wanted_parts(std::uint64_t spheres) const;
  bool stay() const { return !without_halos_ && parts_.size() <= workers_.size(); }
  void build_those_that_stay(const Chain& chain);
  void with_room(const Chain& chain, const std::function<void()>& work);
  void for_each_part(const std::function<void(std::uint32_t part, Worker& by)>& work);
  void search_parts(const Chain& chain, const Request& request, Collisions& result);
  void search_part(const Chain& chain, std::uint32_t part, Worker& by, const Request& request,
                   Collisions& result);
  bool search_between(const Chain& chain, const Request& request, Collisions& result);
  std::span<std::uint32_t> place_of_counts(const LocalChain& part, Worker& by, Collisions& result) const;
  void take_counts(const LocalChain& part, const Worker& by, const Request& request,
                   Collisions& result) const;
  void take_pairs(const LocalChain& part, Worker& by, Found& to) const;
  static void leave_out_unasked(const Request& request, Found& found);
  void gather(const Request& request, Collisions& result);
  double slowest(double Timings::*stage) const;
  std::uint64_t spheres_in_halos() const;

  std::vector<Worker> workers_;
  Options options_;
  const Team& team_;
  const Team at_a_time_;  ///< whose members search
  Request prepared_;
  bool in_space_ = false, without_halos_ = false;
  std::vector<LocalChain> parts_;
  std::vector<Found> found_;              ///< of each part, and between them
  LargeVector<Box> boxes_;                ///< of groups, where parts have no halos
  std::uint32_t group_ = 1;               ///< of these
  std::optional<std::uint32_t> spheres_;  ///< of the chain that was built
  bool built_ = false;                    ///< all parts, and they stay
  std::uint64_t between_ = 0;             ///< spheres that were searched for pairs of two parts
  double share_out_ms_ = 0, moved_in_build_ms_ = 0, moved_in_find_ms_ = 0;
};

}  // namespace catena::parts
