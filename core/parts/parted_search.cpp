#include "catena/core/parts/parted_search.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "catena/core/error.h"
#include "catena/core/executor/large_vector.h"

namespace catena::parts {
namespace {

/// A part whose halo is so many times larger than itself is not worth the search.
constexpr std::uint64_t most_halo = 15;

bool all_of(const Request& request, std::uint32_t spheres) {
  return request.queries.within(spheres) == SphereRange{0, spheres};
}

}  // namespace

PartedSearch::PartedSearch(std::vector<std::unique_ptr<PartSearch>> searches, const Options& options,
                           const Team& team)
    : searches_(std::move(searches)),
      scratch_(searches_.size()),
      times_(searches_.size()),
      options_(options),
      team_(team) {}

void PartedSearch::build(const Chain& chain, const Request& request) {
  const Stopwatch watch;
  spheres_.reset();
  prepared_ = request;
  prepared_.queries = {};
  times_.assign(searches_.size(), {});
  part_chain(chain);
  with_room(chain, [&] { build_those_that_stay(chain); });
  spheres_ = chain.size();
  moved_in_build_ms_ = std::max(0.0, watch.ms() - plan_ms_ - slowest(&Timings::build_ms));
  moved_in_find_ms_ = 0;
}

void PartedSearch::find(const Chain& chain, const Request& request, Collisions& result) {
  if (spheres_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
  const Stopwatch watch;
  for (Timings& times : times_) times.find_ms = 0, times.build_ms = built_ ? times.build_ms : 0;
  try {
    with_room(chain, [&] {
      build_those_that_stay(chain);
      found_.assign(parts_.size(), {});
      if (request.want == Request::Want::any)
        result.count.clear();
      else
        resize_large(result.count, chain.size());
      std::atomic<bool> enough{false};
      for_each_part([&](std::uint32_t part, std::size_t by) {
        if (enough) return;
        search_part(chain, part, by, request, result);
        if (request.want == Request::Want::any && found_[part].any) enough = true;
      });
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
void PartedSearch::part_chain(const Chain& chain) {
  const Stopwatch watch;
  built_ = false;
  parts_.clear();
  const std::uint64_t n = chain.size(), room = std::max<std::uint64_t>(1, options_.room);
  const auto searches = static_cast<std::uint32_t>(searches_.size());
  auto parts = static_cast<std::uint32_t>((n + room - 1) / room);
  if (parts > searches) parts = (parts + searches - 1) / searches * searches;
  const std::uint64_t worth = n / std::max(1u, options_.least_part);
  parts = std::max({parts, static_cast<std::uint32_t>(std::min<std::uint64_t>(options_.parts, worth)), 1u});
  for (;;) {
    partition_.emplace(chain, parts, options_.partition, team_);
    if (partition_->size() == 1 || partition_->greatest() <= room) break;
    parts = more_parts(parts, partition_->greatest());
    if (std::uint64_t{parts} * room / (most_halo + 1) > n + room)
      throw CapacityError("the chain cannot be parted for a memory of " + std::to_string(room) +
                          " spheres: so many touch one another that a part of " + std::to_string(n / parts) +
                          " comes with more others than there is room for");
  }
  std::vector<std::optional<LocalChain>> made(partition_->size());
  team_.for_each_range(partition_->size(), 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t p = begin; p < end; ++p) made[p].emplace(chain, *partition_, p);
  });
  for (auto& part : made) parts_.push_back(std::move(*part));
  plan_ms_ = watch.ms();
}

std::uint32_t PartedSearch::more_parts(std::uint32_t parts, std::uint64_t greatest) const {
  const double wanted = 1.1 * parts * (static_cast<double>(greatest) / static_cast<double>(options_.room));
  return std::max(parts + 1, static_cast<std::uint32_t>(std::min(wanted, 4.0 * parts)));
}

void PartedSearch::with_room(const Chain& chain, const std::function<void()>& work) {
  constexpr std::uint64_t least_room = 4096;
  for (;;) try {
      return work();
    } catch (const CapacityError&) {
      if (!options_.room_is_guessed || options_.room < least_room) throw;
      for (const auto& search : searches_) search->drop();
      const std::uint64_t largest = partition_->greatest();
      options_.room = std::min(options_.room, largest) / 4 * 3;
      part_chain(chain);
    }
}

void PartedSearch::build_those_that_stay(const Chain& chain) {
  if (built_ || !stay()) return;
  for_each_part([&](std::uint32_t part, std::size_t by) {
    searches_[by]->build(chain, parts_[part], prepared_);
    times_[by].build_ms += searches_[by]->timings().build_ms;
    times_[by].start_ms += searches_[by]->timings().start_ms;
  });
  built_ = true;
}

/// Parts that stay have a search of their own, others the next that is free. Throws what the first of them
/// threw, when all are done with what they had begun.
void PartedSearch::for_each_part(const std::function<void(std::uint32_t part, std::size_t by)>& work) {
  std::atomic<std::uint32_t> next{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;
  std::exception_ptr first;
  const auto run = [&](std::size_t by) {
    try {
      if (stay()) return work(static_cast<std::uint32_t>(by), by);
      for (std::uint32_t part; !failed && (part = next++) < parts_.size();) work(part, by);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
      failed = true;
    }
  };
  std::vector<std::jthread> others;
  for (std::size_t by = 1; by < std::min(searches_.size(), parts_.size()); ++by) others.emplace_back(run, by);
  run(0);
  others.clear();
  if (first) std::rethrow_exception(first);
}

void PartedSearch::search_part(const Chain& chain, std::uint32_t p, std::size_t by, const Request& request,
                               Collisions& result) {
  const LocalChain& part = parts_[p];
  PartSearch& search = *searches_[by];
  if (!built_) search.build(chain, part, prepared_);
  Request local = request;
  local.queries = part.own();
  if (!all_of(request, chain.size()))  // what is not asked for is left out of all pairs of the part
    local.want = Request::Want::pairs, local.pair_limit = std::numeric_limits<std::uint64_t>::max();
  try {
    search.find(part, local, scratch_[by]);
    take(part, request, scratch_[by], found_[p], result);
  } catch (const PairLimitExceeded& exceeded) {
    found_[p].any = true;
    found_[p].pairs = exceeded.found();
  }
  const Timings of_part = search.timings();
  if (!built_) times_[by].build_ms += of_part.build_ms;
  times_[by].find_ms += of_part.find_ms;
  times_[by].start_ms += of_part.start_ms;
}

/// What was found in a part, in the numbers of the whole chain.
void PartedSearch::take(const LocalChain& part, const Request& request, const Collisions& found, Found& to,
                        Collisions& result) const {
  constexpr std::uint32_t grain = 1u << 15;
  const bool all = all_of(request, *spheres_);
  if (request.want != Request::Want::any) {
    std::uint32_t local = 0;
    for (const SphereRange& run : part.runs()) {
      const std::uint32_t first = std::max(local, part.own().begin),
                          end = std::min(local + run.size(), part.own().end);
      if (first < end)
        team_.for_each_range(end - first, grain, [&](std::uint32_t begin, std::uint32_t stop) {
          const std::uint32_t* const from = found.count.data() + first;
          std::uint32_t* const at = result.count.data() + run.begin + (first - local);
          std::copy(from + begin, from + stop, at + begin);
          if (all) return;
          for (std::uint32_t k = begin; k < stop; ++k)
            if (!request.queries.contains(run.begin + (first - local) + k)) at[k] = 0;
        });
      local += run.size();
    }
  }
  to.any = found.found;
  to.pairs = found.pair_count;
  to.list.resize(found.pairs.size());
  team_.for_each_range(static_cast<std::uint32_t>(found.pairs.size()), grain,
                       [&](std::uint32_t begin, std::uint32_t end) {
                         for (std::uint32_t k = begin; k < end; ++k) {
                           const std::uint32_t a = part.id(found.pairs[k].i), b = part.id(found.pairs[k].j);
                           to.list[k] = {std::min(a, b), std::max(a, b)};
                         }
                       });
  if (all) return;
  std::erase_if(to.list, [&](const Pair& pair) { return !request.queries.contains(pair.i); });
  to.pairs = to.list.size();
  to.any = to.pairs > 0;
}

/// The pairs of all parts, part after part.
void PartedSearch::gather(const Request& request, Collisions& result) {
  result.pairs.clear();
  result.found = std::ranges::any_of(found_, &Found::any);
  result.pair_count = 0;
  if (request.want == Request::Want::any) return;
  for (const Found& found : found_) result.pair_count += found.pairs;
  if (request.want != Request::Want::pairs) return;
  if (result.pair_count > request.pair_limit) throw PairLimitExceeded(result.pair_count, request.pair_limit);
  resize_large(result.pairs, result.pair_count);
  std::vector<std::uint64_t> at;
  std::uint64_t next = 0;
  for (const Found& found : found_) at.push_back(next), next += found.list.size();
  team_.for_each_range(
      static_cast<std::uint32_t>(found_.size()), 1, [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t p = begin; p < end; ++p) {
          std::ranges::copy(found_[p].list, result.pairs.begin() + static_cast<std::ptrdiff_t>(at[p]));
          std::vector<Pair>().swap(found_[p].list);
        }
      });
}

double PartedSearch::slowest(double Timings::*stage) const {
  double most = 0;
  for (const Timings& times : times_) most = std::max(most, times.*stage);
  return most;
}

Timings PartedSearch::timings() const {
  return {.build_ms = plan_ms_ + slowest(&Timings::build_ms),
          .find_ms = slowest(&Timings::find_ms),
          .transfer_ms = moved_in_build_ms_ + moved_in_find_ms_,
          .start_ms = slowest(&Timings::start_ms)};
}

std::vector<WorkDone> PartedSearch::work() const {
  std::uint64_t halo = 0, extra = 0;
  for (const LocalChain& part : parts_) halo += part.size() - part.own().size(), extra += part.extra().size();
  return {{"parts", parts_.size()},
          {"parted by space", partition_ && partition_->in_space()},
          {"spheres in halos", halo},
          {"neighbours across pieces", extra}};
}

}  // namespace catena::parts
