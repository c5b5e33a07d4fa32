#pragma once
#include <cstdint>
#include <span>

#include "catena/core/export.h"
#include "catena/core/pair.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// All pairs of a frame and how many each sphere has, carried on to the next one: what that does not change
/// is not written again. Counts follow the pairs where they stand, and are made of them when they are asked
/// for else.
class CATENA_API FrameAnswer {
 public:
  /// The places of its pairs have 32 bits: of a frame with more none is kept.
  static constexpr std::uint64_t most_pairs = 0xFFFFFFFF;

  /// Where a search may leave an answer; `found` then, if it is all pairs and their counts.
  Collisions& room() { return all_; }
  void found() { counts_ = Counts::stand; }
  /// Takes over an answer of all pairs and their counts.
  void copy(const Collisions& from);

  std::span<const Pair> pairs() const { return all_.pairs; }

  /// Sphere i of the next frame, of n, is what i + s was, where both are; pairs with one that is gone go.
  void shift(std::uint32_t n, std::int64_t s);
  /// Takes out the pairs at these places of pairs(), which ascend, and puts in those that are there instead.
  /// O(both).
  void exchange(std::span<const std::uint32_t> places, std::span<const Pair> instead);
  /// Another answer, which write(pairs, counts, stand) makes of this one; `stand`: counts are those of the
  /// pairs.
  template <class Write>
  void rewrite(const Write& write) {
    write(all_.pairs, all_.count, counts_ == Counts::stand);
    counts_ = Counts::stand;
  }

  /// Fills `result`, for n spheres, as `request` asks. Throws PairLimitExceeded.
  void report(std::uint32_t n, const Request& request, Collisions& result) const;
  /// The answer itself, for n spheres, all of which are asked for; pairs are there also for counts. Throws
  /// PairLimitExceeded. O(1) where counts stand or are not asked for.
  const Collisions& standing(std::uint32_t n, const Request& request);

 private:
  enum class Counts {
    stand,   ///< those of the pairs
    zero,    ///< n of them, each 0
    unknown  ///< of no meaning
  };
  bool few_pairs(std::size_t n) const { return all_.pairs.size() < n / 8; }

  Collisions all_;
  Counts counts_ = Counts::unknown;
};

}  // namespace catena
