#pragma once
#include <algorithm>
#include <cmath>

#include "catena/core/export.h"

namespace catena {

/// When a kept list pays, how thick its skin is, and so how long it lives: from what was measured. Chooses
/// between ways to the same answer, and decides nothing else.
///
/// A list that is to live k frames in which spheres move by v each needs a skin of k v, and the thicker it is
/// the more pairs it holds: a frame costs `use` + `growth` k, and its share of pruning. With one rebuild, the
/// mean of k frames is
///     (rebuild + (k - 1) use) / k + growth k,   least where k = sqrt((rebuild - use) / growth).
class CATENA_API ListPolicy {
 public:
  static constexpr double shortest = 2, longest = 64;  ///< lives, frames

  /// A full search of a frame took so long. The first ones touch memory for the first time, and are no
  /// measure of the next.
  void searched(double ms) {
    full_ms_ = searches_ < cold_searches ? ms : blend(full_ms_, std::min(ms, 2 * full_ms_));
    ++searches_;
  }
  /// A list of thick spheres was made, of a chain whose spheres were to move by `move` a frame.
  void rebuilt(double ms, double move) {
    // The first ones touch memory for the first time, too.
    rebuild_ms_ = blend(rebuild_ms_, made_ < cold_searches ? std::min(ms, 2 * full_ms_) : ms);
    move_ = move, ++made_;
    uses_ = 0;
  }
  /// A frame was answered by a list with this skin; `near` of its pairs, `found` of which collide.
  void used(double ms, double skin, double near, double found) {
    const double pair_ms = ms / (near + 1);
    growth_ms_ = skin > 0 ? pair_ms * std::max(0.0, near - found) / skin * move_ : 0;
    use_ms_ = blend(use_ms_, std::max(0.0, ms - growth_ms_ * (move_ > 0 ? skin / move_ : 0)));
    ++uses_;
  }
  /// A frame was answered after the inner list was pruned again.
  void pruned(double ms) {
    if (prunes_++ == 0) return;  // it touches memory for the first time
    prune_ms_ = blend(prune_ms_, std::max(0.0, ms - use_ms_) / (uses_ + 1));
    uses_ = 0;
  }
  void forget() { *this = {}; }

  /// Frames that a list made now should live.
  double life() const {
    const double saved = rebuild_ms() - use_ms(), growth = growth_ms_ > 0 ? growth_ms_ : full_ms_ / 50;
    return saved > 0 && growth > 0 ? std::clamp(std::sqrt(saved / growth), shortest, longest) : shortest;
  }
  /// What a frame costs on average by lists of that life.
  double mean_ms() const {
    const double k = life();
    return (rebuild_ms() + (k - 1) * use_ms()) / k + growth_ms_ * k + prune_ms_;
  }
  /// Nothing was measured that tells of the next frames.
  bool cold() const { return searches_ < cold_searches; }
  /// Guessed before the first list was made and used; not before a full search was measured.
  bool pays() const { return !cold() && mean_ms() < 0.9 * full_ms_; }
  /// A list that stands, whatever making it took.
  bool use_pays() const { return use_ms() + growth_ms_ * life() + prune_ms_ < 0.9 * full_ms_; }
  double full_ms() const { return full_ms_; }

 private:
  static constexpr unsigned cold_searches = 2;
  static double blend(double old, double latest) { return old > 0 ? 0.7 * old + 0.3 * latest : latest; }
  double rebuild_ms() const { return made_ > 0 ? rebuild_ms_ : 2 * full_ms_; }
  double use_ms() const { return use_ms_ > 0 ? use_ms_ : full_ms_ / 4; }

  double full_ms_ = 0, rebuild_ms_ = 0, use_ms_ = 0, growth_ms_ = 0, move_ = 0;
  double prune_ms_ = 0;                          ///< of a frame, on average
  unsigned made_ = 0, searches_ = 0, prunes_ = 0, uses_ = 0;  ///< uses since the list was pruned
};

}  // namespace catena
