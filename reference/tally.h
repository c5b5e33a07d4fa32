#pragma once
#include <algorithm>
#include <cstdint>

#include "catena/core/error.h"
#include "catena/core/strategy/request.h"
#include "catena/reference/answer.h"

namespace catena::reference {

/// Gathers colliding pairs, each reported once, into an Answer. Past the request's pair limit it goes on
/// counting but frees its pairs, so that a flood cannot take the memory and the error still states the true
/// number.
class Tally {
 public:
  Tally(std::uint32_t n, const Request& request) : limit_(request.pair_limit) {
    answer_.count.assign(n, 0);
    answer_.has_pairs = request.want == Request::Want::pairs;
    keep_ = answer_.has_pairs;
  }

  /// One colliding pair, in either order. Amortised O(1).
  void add(std::uint32_t a, std::uint32_t b) {
    ++answer_.count[a];
    ++answer_.count[b];
    ++answer_.pair_count;
    if (!keep_) return;
    if (answer_.pair_count > limit_) {
      keep_ = false;
      std::vector<Pair>().swap(answer_.pairs);
      return;
    }
    answer_.pairs.push_back(a < b ? Pair{a, b} : Pair{b, a});
  }

  /// Throws PairLimitExceeded when pairs were wanted and there are more than the limit. O(p log p) for p
  /// pairs.
  Answer finish() && {
    if (answer_.has_pairs && answer_.pair_count > limit_) throw PairLimitExceeded(answer_.pair_count, limit_);
    if (!std::ranges::is_sorted(answer_.pairs)) std::ranges::sort(answer_.pairs);
    return std::move(answer_);
  }

 private:
  Answer answer_;
  std::uint64_t limit_;
  bool keep_;
};

}  // namespace catena::reference
