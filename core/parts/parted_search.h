#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/parts/local_chain.h"
#include "catena/core/parts/part_search.h"
#include "catena/core/parts/parted_answer.h"
#include "catena/core/parts/partition.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/timings.h"
#include "catena/core/strategy/work_done.h"

namespace catena::parts {

/// Finds the collisions of a chain part after part, by several searches at a time, each in a thread of its
/// own.
///
/// How the chain is parted depends on what it is like. Where chain order does not tangle the parts they come
/// without halos, and the boxes of their groups are made as they are moved; the few groups that then turn out
/// to touch other parts are searched together, for pairs of two parts. So the chain is read once. Else parts
/// come with halos. Parts that have a search to themselves are built once and stay there; others come and go
/// with each find.
class CATENA_API PartedSearch {
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
  /// One search, and what it keeps.
  struct Worker {
    std::unique_ptr<PartSearch> search;
    Collisions found;
    std::vector<std::uint32_t> count;
    Timings times;  ///< summed up

    void add_build() {
      times.build_ms += search->timings().build_ms, times.start_ms += search->timings().start_ms;
    }
    void add_find() {
      times.find_ms += search->timings().find_ms, times.start_ms += search->timings().start_ms;
    }
  };

  void share_out(const Chain& chain);
  void part_with_halos(const Chain& chain);
  void set_parts(const Chain& chain, const Partition& partition, bool without_halos);
  std::uint32_t wanted_parts(std::uint64_t spheres) const;
  /// One more search is needed for what is between parts that come without halos.
  bool stay() const { return parts_.size() + without_halos_ <= workers_.size(); }
  void build_those_that_stay(const Chain& chain);
  void with_room(const Chain& chain, const std::function<void()>& work);
  void for_each_part(const std::function<void(std::uint32_t part, Worker& by)>& work);
  void search_parts(const Chain& chain, const Request& request, Collisions& result);
  void search_part(const Chain& chain, std::uint32_t part, Worker& by);
  void make_room_for_boxes(const Chain& chain);
  void build_part(const Chain& chain, std::uint32_t part, Worker& by);
  bool find_touching(const Chain& chain);
  Worker& between_parts();
  void build_between(const Chain& chain);
  void search_between();
  double slowest(double Timings::*stage) const;
  std::uint64_t spheres_in_halos() const;

  std::vector<Worker> workers_;
  Options options_;
  const Team& team_;
  PartedAnswer answer_;
  const Team at_a_time_;  ///< whose members search
  Request prepared_;
  bool in_space_ = false, without_halos_ = false;
  std::vector<LocalChain> parts_;
  LargeVector<Box> boxes_;                ///< of groups, where parts have no halos
  std::uint32_t group_ = 1;               ///< of these
  std::vector<std::uint32_t> first_;      ///< group of each part, and their number
  std::optional<LocalChain> between_;     ///< where there are any, all of these that touch another part
  std::optional<std::uint32_t> spheres_;  ///< of the chain that was built
  bool built_ = false;                    ///< all parts, and they stay
  double share_out_ms_ = 0, moved_in_build_ms_ = 0, moved_in_find_ms_ = 0;
};

}  // namespace catena::parts
