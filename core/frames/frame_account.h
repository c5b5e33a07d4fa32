#pragma once
#include <algorithm>

#include "catena/core/export.h"

namespace catena {

/// What something that helps to search some films saved of full searches, and what it lost, in full searches.
/// It is tried while as much was saved, or a small share of what frames took: so whatever frames do, and
/// however wrongly it was guessed what it would take, a film is not searched slower by more than that share
/// and a few full searches.
class CATENA_API FrameAccount {
 public:
  void begin() { balance_ = first; }
  /// There is something left to try with.
  bool may_try() const { return balance_ >= 0; }
  /// One more frame.
  void frame() { balance_ = std::min(balance_ + share, most); }
  /// A frame took `ms` by it, and a full search would about `full_ms`. Loses no more than so many of these:
  /// what takes longer says that something else ran meanwhile.
  void used(double ms, double full_ms, double most_lost) {
    if (full_ms > 0) balance_ -= std::min((ms - full_ms) / full_ms, most_lost);
  }

 private:
  static constexpr double share = 0.01;          ///< of a full search, a frame
  static constexpr double first = 1, most = 16;  ///< lost before any frame; of what was saved

  double balance_ = first;
};

}  // namespace catena
