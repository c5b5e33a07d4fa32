#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/executor/lane_counts.h"
#include "catena/core/executor/shared_pairs.h"
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
    Lane(PairCollector& owner, LaneCounts* shared)
        : owner_(owner),
          counts_(owner.keep_counts_ ? owner.result_.count.data() : nullptr),
          alone_(owner.lanes_ == 1),
          room_(owner.any_only_ ? 1 : buffer_.size()),
          shared_(shared),
          writer_(owner.pairs_) {}

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
        count_each(pairs);
      else if (counts_ != nullptr)
        shared_->add(pairs);
      if (!pairs.empty()) hand_over(pairs);
    }
    /// Where a search may count itself, [sphere], instead of this; null where it may not, as others count
    /// too, or nobody does, or not all spheres are searched for.
    std::uint32_t* counts() const { return owner_.everything_ && alone_ ? counts_ : nullptr; }
    /// Pairs whose collisions the search counted itself.
    void counted(std::span<const Pair> pairs) {
      if (!pairs.empty()) hand_over(pairs);
    }
    /// True when the request is answered already and the search may stop.
    bool satisfied() const { return any_will_do() && owner_.found_.load(std::memory_order_relaxed) > 0; }
    /// One pair is all that is asked for: whoever keeps pairs back hands over the first.
    bool any_will_do() const { return owner_.any_only_; }

   private:
    friend class PairCollector;

    /// Pairs side by side often have a sphere in common, whose count would have to be stored before it can
    /// be read again: four places are gone on from in turn.
    void count_each(std::span<const Pair> pairs) {
      const std::size_t part = pairs.size() / 4;
      const Pair* p = pairs.data();
      for (const Pair* const end = p + part; p != end; ++p)
        for (const Pair* const q : {p, p + part, p + 2 * part, p + 3 * part})
          ++counts_[q->i], ++counts_[q->j];
      for (const Pair& rest : pairs.subspan(4 * part)) ++counts_[rest.i], ++counts_[rest.j];
    }
    void one_more(std::uint32_t i) {
      if (alone_)
        ++counts_[i];
      else
        shared_->add(i);
    }
    void keep(std::span<const Pair> pairs) {
      if (owner_.team_ != nullptr) return writer_.write(pairs);
      std::vector<Pair>& all = this == &owner_.first_ ? owner_.result_.pairs : own_;
      append_large(all, pairs, owner_.likely_);
    }

    /// Stores what is buffered, or `pairs`, while pairs are kept, and tells the other lanes how many were
    /// found; past the limit nothing more is kept.
    void hand_over() {
      hand_over({buffer_.data(), buffered_});
      buffered_ = 0;
    }
    void hand_over(std::span<const Pair> pairs) {
      if (owner_.keep_pairs_.load(std::memory_order_relaxed)) keep(pairs);
      const std::uint64_t before = owner_.found_.fetch_add(pairs.size(), std::memory_order_relaxed);
      if (before + pairs.size() > owner_.limit_) owner_.keep_pairs_.store(false, std::memory_order_relaxed);
    }

    PairCollector& owner_;
    std::uint32_t* const counts_;  // null when counts are not wanted
    const bool alone_;             // no other lane counts
    const std::size_t room_;       // one pair is all, when any will do
    std::size_t buffered_ = 0;
    std::array<Pair, 512> buffer_;  // pairs found and not handed over yet
    LaneCounts* const shared_;      // where there are others, else null
    std::vector<Pair> own_;         // of every lane but the first, which writes the result
    SharedPairs::Writer writer_;    // with a team, instead
  };

  /// Empties `result` (keeping its memory) for n spheres and opens `lanes` lanes.
  PairCollector(std::uint32_t n, const Request& request, Collisions& result, unsigned lanes = 1)
      : PairCollector(n, request, result, lanes, nullptr, own_counts_) {}
  /// A lane for each member of the team, which shares out what there is to do before and after the search
  /// too. Its searches report by collide() alone. `counts` is memory, kept from search to search.
  PairCollector(std::uint32_t n, const Request& request, Collisions& result, const Team& team,
                std::vector<LaneCounts>& counts)
      : PairCollector(n, request, result, team.size(), team.size() > 1 ? &team : nullptr, counts) {}
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
    if (team_ != nullptr) gather_pairs();
    if (any_only_) return;
    if (lanes_ > 1) add_up_counts();
    result_.pair_count = found;
    if (pairs_wanted_ && found > limit_) {
      std::vector<Pair>().swap(result_.pairs);  // gives the memory back
      throw PairLimitExceeded(found, limit_);
    }
    for (const Lane& lane : others_)
      result_.pairs.insert(result_.pairs.end(), lane.own_.begin(), lane.own_.end());
  }

 private:
  PairCollector(std::uint32_t n, const Request& request, Collisions& result, unsigned lanes, const Team* team,
                std::vector<LaneCounts>& counts)
      : result_(emptied(result, n, request, team)),
        team_(team),
        limit_(request.pair_limit),
        likely_(static_cast<std::size_t>(std::min(limit_, std::uint64_t{pairs_a_sphere} * n) / lanes)),
        queries_(request.queries.within(n)),
        everything_(queries_ == SphereRange{0, n}),
        any_only_(request.want == Request::Want::any),
        keep_counts_(!any_only_),
        pairs_wanted_(request.want == Request::Want::pairs),
        lanes_(lanes),
        keep_pairs_(pairs_wanted_),
        counts_(counts_of(lanes, keep_counts_ ? n : 0, counts)),
        first_(*this, lanes > 1 ? &counts_[0] : nullptr) {
    if (lanes > 1) {
      others_.reserve(lanes - 1);
      for (unsigned k = 1; k < lanes; ++k) others_.emplace_back(*this, &counts_[k]);
    }
  }

  static std::vector<LaneCounts>& counts_of(unsigned lanes, std::size_t size,
                                            std::vector<LaneCounts>& counts) {
    if (lanes == 1) return counts;
    counts.resize(lanes);
    for (LaneCounts& lane : counts) lane.reset(size);
    return counts;
  }

  /// What the lanes counted; with a team nothing else was, and what is in the result is of an earlier one.
  void add_up_counts() {
    const std::span<std::uint32_t> counts = result_.count;
    const auto pages = static_cast<std::uint32_t>((counts.size() + LaneCounts::page - 1) / LaneCounts::page);
    const auto add = [&](std::uint32_t begin, std::uint32_t end) {
      if (team_ != nullptr)
        std::fill(counts.data() + std::size_t{begin} * LaneCounts::page,
                  counts.data() + std::min(counts.size(), std::size_t{end} * LaneCounts::page), 0u);
      for (LaneCounts& lane : counts_) lane.move_pages_to(counts, begin, end);
    };
    if (team_ != nullptr)
      team_->for_each_range(pages, 4, add);
    else
      add(0, pages);
    for (LaneCounts& lane : counts_) lane.move_full_to(counts);
  }

  void gather_pairs() {
    const auto writers = [&](const auto& body) {
      body(first_.writer_);
      for (Lane& lane : others_) body(lane.writer_);
    };
    pairs_.gather(writers, result_.pairs);
  }

  static Collisions& emptied(Collisions& result, std::uint32_t n, const Request& request, const Team* team) {
    const std::uint32_t counts = request.want == Request::Want::any ? 0 : n;
    result.found = false;
    result.pair_count = 0;
    if (team == nullptr) {
      result.pairs.clear();
      result.count.clear();
      result.count.resize(counts);  // to a number that the compiler knows: by memset
    } else {
      result.count.resize(counts);
    }
    return result;
  }

  static constexpr unsigned pairs_a_sphere = 16;  // where there are many: about as many as in a dense ball

  Collisions& result_;
  const Team* const team_;  // null where one thread does it
  const std::uint64_t limit_;
  const std::size_t likely_;  // pairs of a lane, where there are many
  const SphereRange queries_;
  const bool everything_;  // the queries are all spheres
  const bool any_only_, keep_counts_, pairs_wanted_;
  const unsigned lanes_;
  std::atomic<bool> keep_pairs_;  // false once the limit is passed
  alignas(64) std::atomic<std::uint64_t> found_{0};
  std::vector<LaneCounts> own_counts_;
  std::vector<LaneCounts>& counts_;  // [lane]
  std::vector<Pair> none_;
  SharedPairs pairs_{team_ != nullptr ? result_.pairs : none_, likely_};
  Lane first_;
  std::vector<Lane> others_;
};

}  // namespace catena
