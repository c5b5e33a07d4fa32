#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/executor/lane_counts.h"
#include "catena/core/executor/team.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// Gathers the result of one find on the host: counts everything, keeps pairs while they are wanted and the
/// limit holds, and leaves out what the request's range of queries does. One Lane a worker; lanes need no
/// lock, and lie apart in memory. Memory for pairs is bounded by the limit. With one lane nothing is
/// allocated once warm.
class PairCollector {
 public:
  class alignas(64) Lane {
   public:
    explicit Lane(PairCollector& owner)
        : owner_(owner),
          counts_(owner.keep_counts_ ? owner.result_.count.data() : nullptr),
          alone_(owner.lanes_ == 1),
          room_(owner.any_only_ ? 1 : buffer_.size()),
          shared_(owner.result_.count.size()) {}

    /// One colliding pair, i < j, reported once over all lanes.
    void pair(std::uint32_t i, std::uint32_t j) {
      if (!owner_.everything_ && !owner_.queries_.contains(i)) return;
      buffer_[buffered_++] = {i, j};
      if (buffered_ == room_) hand_over();
    }
    /// The number of collisions that sphere i was found to have; each sphere belongs to one lane.
    void count(std::uint32_t i, std::uint32_t collisions) {
      if (counts_ != nullptr && owner_.queries_.contains(i)) counts_[i] = collisions;
    }
    /// A pair, i < j, and one collision more for both: for searches that meet a pair at one place, by any
    /// lane.
    void collide(std::uint32_t i, std::uint32_t j) {
      if (counts_ != nullptr) {
        if (owner_.everything_ || owner_.queries_.contains(i)) one_more(i);
        if (owner_.everything_ || owner_.queries_.contains(j)) one_more(j);
      }
      pair(i, j);
    }
    /// The same for many pairs, which are handed over at once.
    void collide(std::span<const Pair> pairs) {
      if (!owner_.everything_) {
        for (const Pair& p : pairs) collide(p.i, p.j);
        return;
      }
      if (counts_ != nullptr && alone_)
        for (const Pair& p : pairs) ++counts_[p.i], ++counts_[p.j];
      else if (counts_ != nullptr)
        for (const Pair& p : pairs) one_more(p.i), one_more(p.j);
      if (!pairs.empty()) hand_over(pairs);
    }
    /// True when the request is answered already and the search may stop.
    bool satisfied() const { return owner_.any_only_ && owner_.found_.load(std::memory_order_relaxed) > 0; }

   private:
    friend class PairCollector;

    void one_more(std::uint32_t i) {
      if (alone_)
        ++counts_[i];
      else
        shared_.add(i);
    }
    std::vector<Pair>& store() {
      return this == &owner_.first_ && owner_.team_ == nullptr ? owner_.result_.pairs : own_;
    }

    /// Stores what is buffered, or `pairs`, while pairs are kept, and tells the other lanes how many were
    /// found; past the limit nothing more is kept.
    void hand_over() {
      hand_over({buffer_.data(), buffered_});
      buffered_ = 0;
    }
    void hand_over(std::span<const Pair> pairs) {
      if (owner_.keep_pairs_.load(std::memory_order_relaxed))
        store().insert(store().end(), pairs.begin(), pairs.end());
      const std::uint64_t before = owner_.found_.fetch_add(pairs.size(), std::memory_order_relaxed);
      if (before + pairs.size() > owner_.limit_) owner_.keep_pairs_.store(false, std::memory_order_relaxed);
    }

    PairCollector& owner_;
    std::uint32_t* const counts_;  // null when counts are not wanted
    const bool alone_;             // no other lane counts
    const std::size_t room_;       // one pair is all, when any will do
    std::size_t buffered_ = 0;
    std::array<Pair, 512> buffer_;  // pairs found and not handed over yet
    std::vector<Pair> own_;  // of every lane but the first, which writes the result; with a team, of all
    LaneCounts shared_;      // where there are others
  };

  /// Empties `result` (keeping its memory) for n spheres and opens `lanes` lanes.
  PairCollector(std::uint32_t n, const Request& request, Collisions& result, unsigned lanes = 1)
      : PairCollector(n, request, result, lanes, nullptr) {}
  /// A lane for each member of the team, which shares out what there is to do before and after the search
  /// too. Its searches report by collide() alone.
  PairCollector(std::uint32_t n, const Request& request, Collisions& result, const Team& team)
      : PairCollector(n, request, result, team.size(), team.size() > 1 ? &team : nullptr) {}
  PairCollector(const PairCollector&) = delete;
  PairCollector& operator=(const PairCollector&) = delete;

  Lane& lane(unsigned k) { return k == 0 ? first_ : others_[k - 1]; }
  /// The spheres that are searched for, 0 <= begin <= end <= n.
  SphereRange queries() const { return queries_; }

  /// Call once when all lanes are done. Throws PairLimitExceeded when pairs were wanted and there are too
  /// many.
  void finish() {
    first_.hand_over();
    for (Lane& lane : others_) lane.hand_over();
    const std::uint64_t found = found_.load();
    result_.found = found > 0;
    if (any_only_) return;
    if (lanes_ > 1) add_up_counts();
    result_.pair_count = found;
    if (pairs_wanted_ && found > limit_) {
      std::vector<Pair>().swap(result_.pairs);  // gives the memory back
      throw PairLimitExceeded(found, limit_);
    }
    if (team_ == nullptr) {
      for (const Lane& lane : others_)
        result_.pairs.insert(result_.pairs.end(), lane.own_.begin(), lane.own_.end());
    } else if (pairs_wanted_) {
      gather_pairs(found);
    }
  }

 private:
  PairCollector(std::uint32_t n, const Request& request, Collisions& result, unsigned lanes, const Team* team)
      : result_(emptied(result, n, request, team)),
        team_(team),
        limit_(request.pair_limit),
        queries_(request.queries.within(n)),
        everything_(queries_ == SphereRange{0, n}),
        any_only_(request.want == Request::Want::any),
        keep_counts_(!any_only_),
        pairs_wanted_(request.want == Request::Want::pairs),
        lanes_(lanes),
        keep_pairs_(pairs_wanted_) {
    if (lanes > 1) {
      others_.reserve(lanes - 1);
      for (unsigned k = 1; k < lanes; ++k) others_.emplace_back(*this);
    }
    if (team_ != nullptr) result_.pairs.swap(last_pairs_);
  }

  const Lane& lane(unsigned k) const { return k == 0 ? first_ : others_[k - 1]; }

  /// What the lanes counted; with a team nothing else was, and what is in the result is of an earlier one.
  void add_up_counts() {
    const std::span<std::uint32_t> counts = result_.count;
    const auto pages = static_cast<std::uint32_t>((counts.size() + LaneCounts::page - 1) / LaneCounts::page);
    const auto add = [&](std::uint32_t begin, std::uint32_t end) {
      if (team_ != nullptr)
        std::fill(counts.begin() + std::size_t{begin} * LaneCounts::page,
                  counts.begin() + std::min(counts.size(), std::size_t{end} * LaneCounts::page), 0);
      for (unsigned k = 0; k < lanes_; ++k) lane(k).shared_.add_pages_to(counts, begin, end);
    };
    if (team_ != nullptr)
      team_->for_each_range(pages, 4, add);
    else
      add(0, pages);
    for (unsigned k = 0; k < lanes_; ++k) lane(k).shared_.add_full_to(counts);
  }

  /// All lanes' pairs, in the memory of an earlier result: what it has need not be made again.
  void gather_pairs(std::uint64_t found) {
    last_pairs_.resize(found);
    std::vector<std::size_t> begin(lanes_);
    for (unsigned k = 1; k < lanes_; ++k) begin[k] = begin[k - 1] + lane(k - 1).own_.size();
    team_->for_each_range(lanes_, 1, [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t k = first; k < end; ++k)
        std::copy(lane(k).own_.begin(), lane(k).own_.end(), last_pairs_.begin() + begin[k]);
    });
    result_.pairs.swap(last_pairs_);
  }

  static Collisions& emptied(Collisions& result, std::uint32_t n, const Request& request, const Team* team) {
    const std::uint32_t counts = request.want == Request::Want::any ? 0 : n;
    result.found = false;
    result.pair_count = 0;
    if (team == nullptr) {
      result.pairs.clear();
      result.count.assign(counts, 0);
    } else {
      result.count.resize(counts);
    }
    return result;
  }

  Collisions& result_;
  const Team* const team_;        // null where one thread does it
  std::vector<Pair> last_pairs_;  // with a team: the memory of the result
  const std::uint64_t limit_;
  const SphereRange queries_;
  const bool everything_;  // the queries are all spheres
  const bool any_only_, keep_counts_, pairs_wanted_;
  const unsigned lanes_;
  std::atomic<bool> keep_pairs_;  // false once the limit is passed
  alignas(64) std::atomic<std::uint64_t> found_{0};
  Lane first_{*this};
  std::vector<Lane> others_;
};

}  // namespace catena
