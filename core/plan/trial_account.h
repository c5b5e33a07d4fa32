#pragma once
#include <algorithm>

#include "catena/core/export.h"

namespace catena {

/// What something that is tried in many searches saved of usual ones, and what it lost, in usual searches. It
/// is tried while as much was saved, or a small share of what all took: so whatever comes, and however
/// wrongly it was guessed what it would take, all take no longer by it than that share and a few searches.
class CATENA_API TrialAccount {
 public:
  /// The share, of a usual search for each that is done, and how many may be lost before any.
  explicit TrialAccount(double share = 0.01, double first = 1)
      : share_(share), first_(first), balance_(first) {}
  void begin() { balance_ = first_; }
  /// There is something left to try with.
  bool may_try() const { return balance_ >= 0; }
  /// One more search, of whichever way.
  void search() { balance_ = std::min(balance_ + share_, most); }
  /// One took `ms` by what is tried, and a usual one would have about `full_ms`. Loses no more than so many
  /// of these: what takes longer says that something else ran meanwhile.
  void used(double ms, double full_ms, double most_lost) {
    if (full_ms > 0) balance_ -= std::min((ms - full_ms) / full_ms, most_lost);
  }

 private:
  static constexpr double most = 16;  ///< of what was saved

  double share_, first_, balance_;
};

}  // namespace catena
