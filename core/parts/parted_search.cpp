#include "catena/core/parts/parted_search.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>

#include "catena/core/error.h"
#include "catena/core/parts/halos.h"

namespace catena::parts {
namespace {

/// A part whose halo is so many times larger than itself is not worth the search.
constexpr std::uint64_t most_halo = 15;

}  // namespace

PartedSearch::PartedSearch(std::vector<std::unique_ptr<PartSearch>> searches, const Options& options,
                           const Team& team)
    : options_(options),
      team_(team),
      answer_(team),
      at_a_time_({"PartedSearch", {{"threads", std::to_string(searches.size()), "a search each"}}, ""}) {
  for (auto& search : searches) workers_.emplace_back().search = std::move(search);
}

void PartedSearch::build(const Chain& chain, const Request& request) {
  const Stopwatch watch;
  spheres_.reset();
  prepared_ = request;
  prepared_.queries = {};
  for (Worker& worker : workers_) worker.times = {};
  share_out(chain);
  with_room(chain, [&] { build_those_that_stay(chain); });
  spheres_ = chain.size();
  moved_in_build_ms_ = std::max(0.0, watch.ms() - share_out_ms_ - slowest(&Timings::build_ms));
  moved_in_find_ms_ = 0;
}

void PartedSearch::find(const Chain& chain, const Request& request, Collisions& result) {
  if (spheres_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
  const Stopwatch watch;
  for (Worker& worker : workers_)
    worker.times.find_ms = 0, worker.times.build_ms = built_ ? worker.times.build_ms : 0;
  try {
    with_room(chain, [&] {
      build_those_that_stay(chain);
      search_parts(chain, request, result);
    });
    answer_.gather();
  } catch (...) {  // what is left of an earlier search is no answer
    result.count.clear();
    std::vector<Pair>().swap(result.pairs);
    throw;
  }
  const double worked_ms = slowest(&Timings::find_ms) + (built_ ? 0 : slowest(&Timings::build_ms));
  moved_in_find_ms_ = std::max(0.0, watch.ms() - worked_ms);
}

/// As many parts as are wanted, or as have room, shared out evenly among the searches.
std::uint32_t PartedSearch::wanted_parts(std::uint64_t spheres) const {
  const std::uint64_t room = std::max<std::uint64_t>(1, options_.room);
  const auto searches = static_cast<std::uint32_t>(workers_.size());
  auto parts = static_cast<std::uint32_t>((spheres + room - 1) / room);
  if (parts > searches) parts = (parts + searches - 1) / searches * searches;
  const std::uint64_t worth = spheres / std::max(1u, options_.least_part);
  return std::max({parts, static_cast<std::uint32_t>(std::min<std::uint64_t>(options_.parts, worth)), 1u});
}

void PartedSearch::share_out(const Chain& chain) {
  const Stopwatch watch;
  const std::uint32_t parts = wanted_parts(chain.size());
  const bool without_halos = parts > 1 && options_.partition.order != Order::space &&
                             (options_.partition.order == Order::chain ||
                              !seems_tangled(chain, parts, options_.partition.group, team_));
  if (without_halos)
    set_parts(chain, cut_in_chain_order(chain.size(), parts, options_.partition.group), true);
  else
    part_with_halos(chain);
  share_out_ms_ = watch.ms();
}

void PartedSearch::part_with_halos(const Chain& chain) {
  const std::uint64_t n = chain.size(), room = std::max<std::uint64_t>(1, options_.room);
  for (std::uint32_t parts = wanted_parts(n);;) {
    Partition partition = part_chain(chain, parts, options_.partition, team_);
    const std::uint64_t greatest = partition.greatest();
    if (partition.parts.size() == 1 || greatest <= room) return set_parts(chain, std::move(partition), false);
    const double more = 1.1 * parts * static_cast<double>(greatest) / static_cast<double>(room);
    parts = std::max(parts + 1, static_cast<std::uint32_t>(std::min(more, 4.0 * parts)));
    if (std::uint64_t{parts} * room / (most_halo + 1) > n + room)
      throw CapacityError("the chain cannot be parted for a memory of " + std::to_string(room) +
                          " spheres: so many touch one another that a part of " + std::to_string(n / parts) +
                          " comes with more others than there is room for");
  }
}

/// All at once or, where that throws, nothing: a find that comes after searches the parts that there were.
void PartedSearch::set_parts(const Chain& chain, const Partition& partition, bool without_halos) {
  const auto parts = static_cast<std::uint32_t>(partition.parts.size());
  std::vector<std::optional<LocalChain>> made(parts);
  team_.for_each_range(parts, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t p = begin; p < end; ++p)
      made[p].emplace(chain, partition.parts[p], workers_[0].search->knows());
  });
  std::vector<LocalChain> all;
  all.reserve(parts);
  for (auto& part : made) all.push_back(std::move(*part));
  parts_.swap(all);
  group_ = options_.partition.group;
  built_ = false;
  in_space_ = partition.in_space, without_halos_ = without_halos;
}

void PartedSearch::with_room(const Chain& chain, const std::function<void()>& work) {
  constexpr std::uint64_t least_room = 4096;
  for (;;) try {
      return work();
    } catch (const CapacityError&) {
      if (!options_.room_is_guessed || options_.room < least_room) throw;
      std::uint64_t greatest = 0;
      for (const LocalChain& part : parts_) greatest = std::max<std::uint64_t>(greatest, part.size());
      options_.room = std::min(options_.room, greatest) / 4 * 3;
      built_ = false;
      for (Worker& worker : workers_) worker.search->drop();
      share_out(chain);
    }
}

void PartedSearch::build_those_that_stay(const Chain& chain) {
  if (built_ || !stay()) return;
  make_room_for_boxes(chain);
  for_each_part([&](std::uint32_t part, Worker& by) { build_part(chain, part, by); });
  if (without_halos_ && !find_touching(chain)) {
    part_with_halos(chain);
    return build_those_that_stay(chain);
  }
  if (between_) build_between(chain);
  built_ = true;
}

void PartedSearch::make_room_for_boxes(const Chain& chain) {
  between_.reset();
  if (without_halos_) boxes_.resize((chain.size() + std::size_t{group_} - 1) / group_);
}

void PartedSearch::build_part(const Chain& chain, std::uint32_t p, Worker& by) {
  const LocalChain& part = parts_[p];
  BoxesWanted boxes;
  if (without_halos_ && part.size() > 0) boxes = {group_, boxes_.data() + part.runs()[0].begin / group_};
  by.search->build(chain, part, prepared_, boxes);
  by.add_build();
}

/// Parts that stay have a search of their own, others the next that is free; after the last part comes what
/// is between parts, if that stays too. Throws what the first of them threw, when all are done with what they
/// had begun.
void PartedSearch::for_each_part(const std::function<void(std::uint32_t part, Worker& by)>& work) {
  std::atomic<std::uint32_t> next{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;
  std::exception_ptr first;
  const auto run = [&](std::uint32_t by) {
    try {
      if (stay()) return work(by, workers_[by]);
      for (std::uint32_t part; !failed && (part = next++) < parts_.size();) work(part, workers_[by]);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
      failed = true;
    }
  };
  const bool and_between = built_ && between_;
  const auto some = static_cast<std::uint32_t>(std::min(workers_.size(), parts_.size() + and_between));
  at_a_time_.for_each_range(some, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t by = begin; by < end; ++by) run(by);
  });
  if (first) std::rethrow_exception(first);
}

void PartedSearch::search_parts(const Chain& chain, const Request& request, Collisions& result) {
  answer_.begin(request, chain.size(), parts_.size(), result);
  if (!built_) make_room_for_boxes(chain);
  std::atomic<bool> enough{false};
  for_each_part([&](std::uint32_t part, Worker& by) {
    if (enough) return;
    if (part == parts_.size()) return search_between();
    search_part(chain, part, by);
    if (answer_.is_answered(part)) enough = true;
  });
  if (!without_halos_ || enough) return;
  if (!built_) {
    if (!find_touching(chain)) {  // they touch one another too much for that
      part_with_halos(chain);
      return search_parts(chain, request, result);
    }
    if (between_) build_between(chain), search_between();
  }
  if (!between_) return;
  const auto part_of = [&](std::uint32_t sphere) {
    return static_cast<std::size_t>(std::ranges::upper_bound(first_, sphere / group_) - first_.begin());
  };
  answer_.take_between(*between_, part_of, between_parts().found);
}

void PartedSearch::search_part(const Chain& chain, std::uint32_t p, Worker& by) {
  const LocalChain& part = parts_[p];
  if (!built_) build_part(chain, p, by);
  const std::span<std::uint32_t> count = answer_.place_of_counts(part, by.count);
  try {
    by.search->find(part, answer_.asked(p, part, by.found), by.found, count);
    answer_.take(p, part, count, by.found);
  } catch (const PairLimitExceeded& exceeded) {
    answer_.take_too_many(p, exceeded.found());
  }
  by.add_find();
}

/// The groups that touch another part, together as a chain of their own: parts came without halos, and pairs
/// of two parts are found there. False when they are too many.
bool PartedSearch::find_touching(const Chain& chain) {
  first_.assign(1, 0);
  for (const LocalChain& part : parts_) first_.push_back(first_.back() + (part.size() + group_ - 1) / group_);
  std::vector<std::uint32_t> touching;
  for (const auto& halo : Halos(boxes_, first_, team_).find())
    touching.insert(touching.end(), halo.begin(), halo.end());
  std::ranges::sort(touching);
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  if (touching.empty()) return true;
  if (touching.size() * std::uint64_t{group_} > options_.room) return false;
  PartRanges ranges;
  for (const std::uint32_t g : touching)
    append(ranges.own, {g * group_, std::min(g * group_ + group_, chain.size())});
  between_.emplace(chain, ranges, workers_[0].search->knows());
  return true;
}

/// A search that has no part of its own.
PartedSearch::Worker& PartedSearch::between_parts() { return workers_[stay() ? parts_.size() : 0]; }

void PartedSearch::build_between(const Chain& chain) {
  Worker& by = between_parts();
  by.search->build(chain, *between_, {}, {});
  by.add_build();
}

void PartedSearch::search_between() {
  Worker& by = between_parts();
  by.count.resize(between_->size());
  by.search->find(*between_, answer_.asked_between(*between_, by.found), by.found, by.count);
  by.add_find();
}

double PartedSearch::slowest(double Timings::*stage) const {
  double most = 0;
  for (const Worker& worker : workers_) most = std::max(most, worker.times.*stage);
  return most;
}

Timings PartedSearch::timings() const {
  return {.build_ms = share_out_ms_ + slowest(&Timings::build_ms),
          .find_ms = slowest(&Timings::find_ms),
          .transfer_ms = moved_in_build_ms_ + moved_in_find_ms_,
          .start_ms = slowest(&Timings::start_ms)};
}

Plan PartedSearch::plan() const {
  return {{.step = "sharing out",
           .left_out = parts_.size() < 2,
           .reason = std::to_string(parts_.size()) + (parts_.size() == 1 ? " part" : " parts") +
                     (in_space_ ? " by space" : " in chain order") + ", " +
                     (built_ ? "each stays where it is" : "which take turns"),
           .actual_ms = share_out_ms_}};
}

std::uint64_t PartedSearch::spheres_in_halos() const {
  std::uint64_t halo = 0;
  for (const LocalChain& part : parts_) halo += part.size() - part.own().size();
  return halo;
}

std::vector<WorkDone> PartedSearch::work() const {
  std::uint64_t extra = 0;
  for (const LocalChain& part : parts_) extra += part.extra().size();
  return {{"parts", parts_.size()},
          {"parted by space", in_space_},
          {"spheres in halos", spheres_in_halos()},
          {"spheres searched for pairs of two parts", between_ ? between_->size() : 0},
          {"neighbours across pieces", extra}};
}

}  // namespace catena::parts
