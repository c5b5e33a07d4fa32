#pragma once
#include <atomic>
#include <cstdint>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// Gathers the result of one find on the host: counts everything, keeps pairs while they are wanted and the limit
/// holds. One Lane a worker; lanes need no lock. Memory for pairs is bounded by the limit.
class PairCollector {
 public:
  class Lane {
   public:
    Lane(PairCollector& owner, std::vector<Pair>& store) : owner_(owner), store_(store) {}

    /// One colliding pair, i < j, reported once over all lanes.
    void pair(std::uint32_t i, std::uint32_t j) {
      ++found_;
      if (owner_.keep_pairs_.load(std::memory_order_relaxed)) store_.push_back({i, j});
      if (found_ - shared_ >= share_every) share();
    }
    /// The number of collisions that sphere i was found to have; each sphere belongs to one lane.
    void count(std::uint32_t i, std::uint32_t collisions) {
      if (owner_.keep_counts_) owner_.result_.count[i] = collisions;
    }
    /// True when the request is answered already and the search may stop.
    bool satisfied() const {
      return owner_.any_only_ && (found_ > 0 || owner_.found_.load(std::memory_order_relaxed) > 0);
    }

   private:
    friend class PairCollector;
    static constexpr std::uint64_t share_every = 4096;

    /// Tells the other lanes how many were found; past the limit nothing more is kept.
    void share() {
      owner_.found_.fetch_add(found_ - shared_, std::memory_order_relaxed);
      shared_ = found_;
      if (owner_.found_.load(std::memory_order_relaxed) > owner_.limit_)
        owner_.keep_pairs_.store(false, std::memory_order_relaxed);
    }

    PairCollector& owner_;
    std::vector<Pair>& store_;
    std::uint64_t found_ = 0, shared_ = 0;
  };

  /// Empties `result` (keeping its memory) for n spheres and opens `lanes` lanes.
  PairCollector(std::uint32_t n, const Request& request, Collisions& result, unsigned lanes = 1)
      : result_(result),
        limit_(request.pair_limit),
        any_only_(request.want == Request::Want::any),
        keep_counts_(!any_only_),
        pairs_wanted_(request.want == Request::Want::pairs),
        keep_pairs_(pairs_wanted_),
        stores_(lanes - 1),
        first_(*this, result.pairs) {
    result.found = false;
    result.pair_count = 0;
    result.pairs.clear();
    result.count.assign(keep_counts_ ? n : 0, 0);
    others_.reserve(stores_.size());
    for (auto& store : stores_) others_.emplace_back(*this, store);
  }

  Lane& lane(unsigned k) { return k == 0 ? first_ : others_[k - 1]; }

  /// Call once when all lanes are done. Throws PairLimitExceeded when pairs were wanted and there are too many.
  void finish() {
    first_.share();
    for (Lane& lane : others_) lane.share();
    const std::uint64_t found = found_.load();
    result_.found = found > 0;
    if (any_only_) return;
    result_.pair_count = found;
    if (pairs_wanted_ && found > limit_) {
      std::vector<Pair>().swap(result_.pairs);  // gives the memory back
      throw PairLimitExceeded(found, limit_);
    }
    for (const auto& store : stores_) result_.pairs.insert(result_.pairs.end(), store.begin(), store.end());
  }

 private:
  Collisions& result_;
  const std::uint64_t limit_;
  const bool any_only_, keep_counts_, pairs_wanted_;
  std::atomic<bool> keep_pairs_;  // false once the limit is passed
  std::atomic<std::uint64_t> found_{0};
  std::vector<std::vector<Pair>> stores_;
  Lane first_;  // apart, so that one lane allocates nothing once the result is warm
  std::vector<Lane> others_;
};

}  // namespace catena
