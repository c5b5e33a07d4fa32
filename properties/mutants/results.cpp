#include <algorithm>
#include <cstdint>
#include <vector>

#include "catena/core/error.h"
#include "catena/properties/mutants/mutant.h"

// Bugs between a search that is right and the answer.
namespace catena::properties {
namespace {

/// Spoils a right answer.
class WrongAnswer : public FaultyTree {
  void answer(const Request& request, Collisions& result) override {
    FaultyTree::answer(request, result);
    if (request.want != Request::Want::any) spoil(result);
  }
  virtual void spoil(Collisions& result) = 0;
};

/// min(count, capacity) pairs, as KittenGpuLBVH and culbvh return them.
class FullBuffer final : public WrongAnswer {
  void spoil(Collisions& result) override {
    constexpr std::uint64_t capacity = 1000;
    result.pair_count = std::min(result.pair_count, capacity);
    result.pairs.resize(std::min(result.pairs.size(), std::size_t{capacity}));
  }
};
const RegisterMutant<FullBuffer> full{"full-buffer-truncates",
                                      "newton#2108: no warning when the buffer is full"};

class EightPairsASphere final : public FaultyTree {
  void hit(std::uint32_t i, std::uint32_t j) override {
    if (counts()[i] < 8) FaultyTree::hit(i, j);
  }
};
const RegisterMutant<EightPairsASphere> eight{"eight-pairs-a-sphere",
                                              "genesis-world#1450: pairs past 8 per box dropped"};

class LimitClamped final : public FaultyTree {
  void answer(const Request& request, Collisions& result) override {
    if (request.want == Request::Want::pairs && pairs().size() > request.pair_limit)
      pairs().resize(request.pair_limit);
    FaultyTree::answer(request, result);
  }
};
const RegisterMutant<LimitClamped> clamped{"pair-limit-clamped", "as many pairs as allowed, and no error"};

/// The error names how many were asked for.
class LimitLies final : public FaultyTree {
  void answer(const Request& request, Collisions& result) override {
    try {
      FaultyTree::answer(request, result);
    } catch (const PairLimitExceeded& error) {
      throw PairLimitExceeded(error.limit() + 1, error.limit());
    }
  }
};
const RegisterMutant<LimitLies> lies{"pair-limit-without-the-number",
                                     "the search stops counting where it stops keeping"};

class EightBitCounts final : public WrongAnswer {
  void spoil(Collisions& result) override {
    for (auto& count : result.count) count = std::min(count, 255u);
  }
};
const RegisterMutant<EightBitCounts> eight_bits{"saturated-8-bit-count",
                                                "no more than 255 collisions a sphere"};

/// Sphere 65,536 is sphere 0.
class SixteenBitIds final : public FaultyTree {
  void hit(std::uint32_t i, std::uint32_t j) override { FaultyTree::hit(i & 0xFFFF, j & 0xFFFF); }
};
const RegisterMutant<SixteenBitIds> sixteen_bit_ids{"16-bit-ids", "pairs kept as two 16-bit numbers, to save memory"};

/// A buffer of the longest chain so far is cleared as far as this one goes.
class StaleAfterLonger final : public WrongAnswer {
  void build(const Chain& chain) override {
    stale_ = longest_ > 8 * chain.size();
    longest_ = std::max(longest_, chain.size());
    FaultyTree::build(chain);
  }
  void spoil(Collisions& result) override {
    if (!stale_ || result.pairs.empty()) return;
    const Pair lost = result.pairs.back();
    result.pairs.pop_back();
    --result.pair_count, --result.count[lost.i], --result.count[lost.j];
  }
  bool stale_ = false;
  std::uint32_t longest_ = 0;
};
const RegisterMutant<StaleAfterLonger> stale_after{"stale-after-a-longer-chain",
                                                   "what a longer chain left in a buffer that is reused"};

class SixteenBitTotal final : public WrongAnswer {
  void spoil(Collisions& result) override { result.pair_count &= 0xFFFF; }
};
const RegisterMutant<SixteenBitTotal> sixteen_bits{"16-bit-total", "the number of pairs wraps at 65,536"};

class OneSidedCounts final : public FaultyTree {
  void hit(std::uint32_t i, std::uint32_t j) override {
    if (i < j) FaultyTree::hit(i, j);
  }
};
const RegisterMutant<OneSidedCounts> one_sided{"counts-one-sided",
                                               "only the first sphere of a pair is counted"};

/// The pair of two lanes is written by both.
class TwoLanes final : public FaultyTree {
  void hit(std::uint32_t i, std::uint32_t j) override {
    FaultyTree::hit(i, j);
    const std::uint32_t lane = 32;
    if (i < j && i / lane != j / lane && j % lane == 0) pairs().push_back({i, j});
  }
};
const RegisterMutant<TwoLanes> lanes{"duplicate-over-two-lanes",
                                     "a pair across a warp's edge is written twice"};

class Unsorted final : public WrongAnswer {
  void spoil(Collisions& result) override {
    for (Pair& p : result.pairs)
      if (p.j % 2 == 1) std::swap(p.i, p.j);
  }
};
const RegisterMutant<Unsorted> unsorted{"pairs-not-sorted", "i > j, as the traversal happened to meet them"};

/// Whether anything collides is read off the last answer (a buffer that nothing cleared).
class StaleAny final : public FaultyTree {
  void answer(const Request& request, Collisions& result) override {
    const bool before = result.found;
    FaultyTree::answer(request, result);
    if (request.want == Request::Want::any) result.found = before;
  }
};
const RegisterMutant<StaleAny> any{"any-from-a-stale-buffer", "a flag that the last search left"};

class NotCleared final : public FaultyTree {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    std::vector<Pair> before = std::move(result.pairs);
    FaultyTree::find(chain, request, result);
    result.pairs.insert(result.pairs.end(), before.begin(), before.end());
  }
};
const RegisterMutant<NotCleared> cleared{"pairs-of-the-last-search", "the buffer is reused and not emptied"};

/// An update lost to another thread, in slow motion: every third search loses its last pair (warp#588; in
/// ToruNiina/lbvh and culbvh a fence is missing).
class LostUpdate final : public WrongAnswer {
  void spoil(Collisions& result) override {
    if (++searches_ % 3 != 0 || result.pairs.empty()) return;
    const Pair lost = result.pairs.back();
    result.pairs.pop_back();
    --result.pair_count;
    --result.count[lost.i], --result.count[lost.j];
  }
  std::uint64_t searches_ = 0;
};
const RegisterMutant<LostUpdate> race{"lost-update-now-and-then",
                                      "warp#588, culbvh: a race that loses a pair sometimes"};

/// The same race on a counter: the pairs are all there.
class LostCount final : public WrongAnswer {
  void spoil(Collisions& result) override {
    if (++searches_ % 3 == 0 && !result.pairs.empty()) --result.count[result.pairs.back().j];
  }
  std::uint64_t searches_ = 0;
};
const RegisterMutant<LostCount> lost_count{"lost-count-now-and-then",
                                           "a counter without an atomic that loses one sometimes"};

/// The answer is right, and its memory made anew each time.
class NewBuffers final : public WrongAnswer {
  void spoil(Collisions& result) override { result.pairs = std::vector<Pair>(result.pairs); }
};
const RegisterMutant<NewBuffers> new_buffers{
    "new-buffers-every-search",
    "culbvh allocates in every search and leaves it out of the figure",
    {},
    Fault::allocation};

}  // namespace
}  // namespace catena::properties
