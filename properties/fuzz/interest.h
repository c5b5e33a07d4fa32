#pragma once
#include <array>
#include <vector>

#include "catena/properties/generators/dice.h"
#include "catena/properties/property.h"

namespace catena::properties {

/// How far a chain drives the algorithms towards their edges; what the search for findings climbs.
struct Interest {
  static constexpr std::size_t targets = 4;
  static constexpr std::array<const char*, targets> names{"deepest tree", "fullest stack", "smallest margin",
                                                          "most pairs"};
  std::array<double, targets> score{};  ///< larger is more interesting; all are >= 0
};

/// Measures chains by one tree variant: its depth, and the most nodes that a depth-first search of any sphere
/// has waiting. The tree is read from visit_bounds, so it may be of any width.
class InterestMeter {
 public:
  explicit InterestMeter(Variant& tree) : tree_(tree) {}
  /// `margin` is the smallest of the chain's pairs that are no neighbours. O(n times nodes).
  Interest of(const Case& test, double margin);

 private:
  Variant& tree_;
};

/// The best few chains seen for each target: what mutation starts from.
class Pool {
 public:
  void offer(const Chain& chain, const Interest& interest);
  bool empty() const { return best_[0].empty(); }
  const Chain& pick(Dice& dice) const;
  Interest best() const;  ///< the highest score of each target

 private:
  static constexpr std::size_t kept = 8;
  struct Entry {
    double score;
    Chain chain;
  };
  std::array<std::vector<Entry>, Interest::targets> best_;  ///< each descending by score
};

}  // namespace catena::properties
