#include "catena/core/parts/parted_search.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

#include "catena/core/error.h"
#include "catena/core/parts/halos.h"

namespace catena::parts {
namespace {

/// A part whose halo is so many times larger than itself is not worth the search.
constexpr std::uint64_t most_halo = 15;
constexpr std::uint32_t grain = 1u << 15;  ///< counts or pairs that one core takes at a time

bool asks_for_all(const Request& request, std::uint32_t spheres) {
  return request.queries.within(spheres) == SphereRange{0, spheres};
}

}  // namespace

PartedSearch::PartedSearch(std::vector<std::unique_ptr<PartSearch>> searches, const Options& options,
                           const Team& team)
    : options_(options),
      team_(team),
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
    gather(request, result);
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
  without_halos_ = parts > workers_.size() && options_.partition.order != Order::space &&
                   (options_.partition.order == Order::chain ||
                    !seems_tangled(chain, parts, options_.partition.group, team_));
  if (without_halos_) {
    group_ = options_.partition.group;
    set_parts(chain, cut_in_chain_order(chain.size(), parts, group_));
  } else {
    part_with_halos(chain);
  }
  share_out_ms_ = watch.ms();
}

void PartedSearch::part_with_halos(const Chain& chain) {
  const std::uint64_t n = chain.size(), room = std::max<std::uint64_t>(1, options_.room);
  without_halos_ = false;
  for (std::uint32_t parts = wanted_parts(n);;) {
    Partition partition = part_chain(chain, parts, options_.partition, team_);
    const std::uint64_t greatest = partition.greatest();
    if (partition.parts.size() == 1 || greatest <= room) return set_parts(chain, std::move(partition));
    const double more = 1.1 * parts * static_cast<double>(greatest) / static_cast<double>(room);
    parts = std::max(parts + 1, static_cast<std::uint32_t>(std::min(more, 4.0 * parts)));
    if (std::uint64_t{parts} * room / (most_halo + 1) > n + room)
      throw CapacityError("the chain cannot be parted for a memory of " + std::to_string(room) +
                          " spheres: so many touch one another that a part of " + std::to_string(n / parts) +
                          " comes with more others than there is room for");
  }
}

void PartedSearch::set_parts(const Chain& chain, Partition partition) {
  built_ = false;
  in_space_ = partition.in_space;
  const auto parts = static_cast<std::uint32_t>(partition.parts.size());
  std::vector<std::optional<LocalChain>> made(parts);
  team_.for_each_range(parts, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t p = begin; p < end; ++p) made[p].emplace(chain, partition.parts[p]);
  });
  parts_.clear();
  for (auto& part : made) parts_.push_back(std::move(*part));
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
      for (Worker& worker : workers_) worker.search->drop();
      share_out(chain);
    }
}

void PartedSearch::build_those_that_stay(const Chain& chain) {
  if (built_ || !stay()) return;
  for_each_part([&](std::uint32_t part, Worker& by) {
    by.search->build(chain, parts_[part], prepared_, {});
    by.times.build_ms += by.search->timings().build_ms;
    by.times.start_ms += by.search->timings().start_ms;
  });
  built_ = true;
}

/// Parts that stay have a search of their own, others the next that is free. Throws what the first of them
/// threw, when all are done with what they had begun.
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
  const auto some = static_cast<std::uint32_t>(std::min(workers_.size(), parts_.size()));
  at_a_time_.for_each_range(some, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t by = begin; by < end; ++by) run(by);
  });
  if (first) std::rethrow_exception(first);
}

void PartedSearch::search_parts(const Chain& chain, const Request& request, Collisions& result) {
  if (request.want == Request::Want::any)
    result.count.clear();
  else
    resize_large(result.count, chain.size());
  found_.resize(parts_.size() + 1);
  for (Found& found : found_) found.any = false, found.pairs = 0, found.list.clear();
  between_ = 0;
  if (without_halos_) boxes_.resize((chain.size() + std::size_t{group_} - 1) / group_);
  std::atomic<bool> enough{false};
  for_each_part([&](std::uint32_t part, Worker& by) {
    if (enough) return;
    search_part(chain, part, by, request, result);
    if (request.want == Request::Want::any && found_[part].any) enough = true;
  });
  if (!without_halos_ || enough || search_between(chain, request, result)) return;
  part_with_halos(chain);  // they touch one another too much for that
  search_parts(chain, request, result);
}

void PartedSearch::search_part(const Chain& chain, std::uint32_t p, Worker& by, const Request& request,
                               Collisions& result) {
  const LocalChain& part = parts_[p];
  if (!built_) {
    BoxesWanted boxes;
    if (without_halos_ && part.size() > 0) boxes = {group_, boxes_.data() + part.runs()[0].begin / group_};
    by.search->build(chain, part, prepared_, boxes);
  }
  Request local = request;
  local.queries = part.own();
  if (!asks_for_all(request, chain.size()))  // what is not asked for is left out of all pairs of the part
    local.want = Request::Want::pairs, local.pair_limit = std::numeric_limits<std::uint64_t>::max();
  by.found.pairs.swap(found_[p].list);
  try {
    by.search->find(part, local, by.found, place_of_counts(part, by, result));
    take_counts(part, by, request, result);
    take_pairs(part, by, found_[p]);
    if (!asks_for_all(request, chain.size())) leave_out_unasked(request, found_[p]);
  } catch (const PairLimitExceeded& exceeded) {
    found_[p].any = true;
    found_[p].pairs = exceeded.found();
  }
  const Timings of_part = by.search->timings();
  if (!built_) by.times.build_ms += of_part.build_ms;
  by.times.find_ms += of_part.find_ms;
  by.times.start_ms += of_part.start_ms;
}

/// Pairs of two parts, where parts came without halos: all groups that touch another part are searched at
/// once. False when they are too many.
bool PartedSearch::search_between(const Chain& chain, const Request& request, Collisions& result) {
  std::vector<std::uint32_t> first{0};
  for (const LocalChain& part : parts_) first.push_back(first.back() + (part.size() + group_ - 1) / group_);
  std::vector<std::uint32_t> touching;
  for (const auto& halo : Halos(boxes_, first, team_).find())
    touching.insert(touching.end(), halo.begin(), halo.end());
  std::ranges::sort(touching);
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  if (touching.empty()) return true;
  if (touching.size() * std::uint64_t{group_} > options_.room) return false;
  PartRanges ranges;
  for (const std::uint32_t g : touching)
    append(ranges.own, {g * group_, std::min(g * group_ + group_, chain.size())});
  const LocalChain part(chain, ranges);
  between_ = part.size();

  Worker& by = workers_[0];
  Found& found = found_.back();
  by.search->build(chain, part, {}, {});
  by.count.resize(part.size());
  by.found.pairs.swap(found.list);
  by.search->find(part, {.pair_limit = std::numeric_limits<std::uint64_t>::max(), .queries = part.own()},
                  by.found, by.count);
  take_pairs(part, by, found);
  const auto part_of = [&](std::uint32_t sphere) { return std::ranges::upper_bound(first, sphere / group_); };
  std::erase_if(found.list, [&](const Pair& pair) { return part_of(pair.i) == part_of(pair.j); });
  if (request.want != Request::Want::any)
    for (const Pair& pair : found.list)
      for (const std::uint32_t sphere : {pair.i, pair.j})
        if (request.queries.contains(sphere)) ++result.count[sphere];
  leave_out_unasked(request, found);
  if (request.want == Request::Want::counts) found.list.clear();
  return true;
}

/// Where they belong, if they lie together there.
std::span<std::uint32_t> PartedSearch::place_of_counts(const LocalChain& part, Worker& by,
                                                       Collisions& result) const {
  if (result.count.empty()) return {};
  if (!in_space_ && part.own().size() > 0)
    return {result.count.data() + part.id(part.own().begin), part.own().size()};
  by.count.resize(part.own().size());
  return by.count;
}

void PartedSearch::take_counts(const LocalChain& part, const Worker& by, const Request& request,
                               Collisions& result) const {
  if (result.count.empty()) return;
  const SphereRange own = part.own(), asked = request.queries.within(*spheres_);
  for (std::size_t k = 0; k < part.runs().size(); ++k) {
    const SphereRange run = part.runs()[k];
    const std::uint32_t begin = std::max(part.begin(k), own.begin),
                        end = std::min(part.begin(k) + run.size(), own.end);
    if (begin >= end) continue;
    const std::uint32_t id = run.begin + (begin - part.begin(k));
    if (in_space_)
      std::copy(by.count.begin() + (begin - own.begin), by.count.begin() + (end - own.begin),
                result.count.begin() + id);
    for (std::uint32_t i = id; !asks_for_all(request, *spheres_) && i < id + (end - begin); ++i)
      if (!asked.contains(i)) result.count[i] = 0;
  }
}

/// In the numbers of the whole chain.
void PartedSearch::take_pairs(const LocalChain& part, Worker& by, Found& to) const {
  to.any = by.found.found;
  to.pairs = by.found.pair_count;
  to.list.swap(by.found.pairs);
  team_.for_each_range(static_cast<std::uint32_t>(to.list.size()), grain,
                       [&](std::uint32_t begin, std::uint32_t end) {
                         for (std::uint32_t k = begin; k < end; ++k) {
                           const std::uint32_t a = part.id(to.list[k].i), b = part.id(to.list[k].j);
                           to.list[k] = {std::min(a, b), std::max(a, b)};
                         }
                       });
}

void PartedSearch::leave_out_unasked(const Request& request, Found& found) {
  std::erase_if(found.list, [&](const Pair& pair) { return !request.queries.contains(pair.i); });
  found.pairs = found.list.size();
  found.any = found.pairs > 0;
}

/// The pairs of all parts, part after part.
void PartedSearch::gather(const Request& request, Collisions& result) {
  result.found = std::ranges::any_of(found_, &Found::any);
  result.pair_count = 0;
  if (request.want != Request::Want::pairs) result.pairs.clear();
  if (request.want == Request::Want::any) return;
  for (const Found& found : found_) result.pair_count += found.pairs;
  if (request.want != Request::Want::pairs) return;
  if (result.pair_count > request.pair_limit) throw PairLimitExceeded(result.pair_count, request.pair_limit);
  if (found_[0].list.size() == result.pair_count) return result.pairs.swap(found_[0].list);
  resize_large(result.pairs, result.pair_count);
  std::size_t at = 0;
  for (Found& found : found_) {
    team_.for_each_range(static_cast<std::uint32_t>(found.list.size()), grain,
                         [&](std::uint32_t begin, std::uint32_t end) {
                           std::copy(found.list.begin() + begin, found.list.begin() + end,
                                     result.pairs.begin() + static_cast<std::ptrdiff_t>(at + begin));
                         });
    at += found.list.size();
  }
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
          {"spheres searched for pairs of two parts", between_},
          {"neighbours across pieces", extra}};
}

}  // namespace catena::parts
