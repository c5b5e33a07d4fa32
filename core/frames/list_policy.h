#pragma once
#include <algorithm>
#include <cmath>

#include "catena/core/export.h"

namespace catena {

/// When a kept list pays, how thick its skin is, and so how long it lives: from what was measured. Chooses
/// between ways to the same answer, and decides nothing else.
///
/// A list that is to live k frames in which spheres move by v each needs a skin of k v where they all go
/// straight on, and less where they go to and fro: how long lists lived says so. The thicker it is the more
/// pairs it holds, which are compared when it is pruned: a frame costs `use`, and `growth` k + `prune` as its
/// share of that. With one rebuild, the mean of k frames is
///     (rebuild + (k - 1) use) / k + growth k + prune,   least where k = sqrt((rebuild - use) / growth).
class CATENA_API ListPolicy {
 public:
  static constexpr double shortest = 2, longest = 64;  ///< lives, frames

  /// A full search of a frame took so long. The first ones touch memory for the first time, and are no
  /// measure of the next.
  void searched(double ms) {
    full_ms_ = searches_ < cold_searches ? ms : blend(full_ms_, std::min(ms, 2 * full_ms_));
    ++searches_;
  }
  /// A list of spheres that are thicker by `skin` was made, of a chain whose spheres were to move by `move` a
  /// frame.
  void rebuilt(double ms, double move, double skin) {
    // The first ones touch memory for the first time, too.
    rebuild_ms_ = blend(rebuild_ms_, made_ < cold_searches ? std::min(ms, 2 * full_ms_) : ms);
    move_ = move, skin_ = skin, ++made_;
    uses_ = 0, lived_ = 1;
  }
  /// A frame was answered by the list, which was not pruned. One that took very long, as something else ran,
  /// is no measure of the next: a list that is given up is not measured any more.
  void used(double ms) {
    use_ms_ = blend(use_ms(), std::min(ms, 2 * use_ms()));
    ++uses_, ++lived_;
  }
  /// A frame was answered after the list was pruned: of its `near` pairs `found` collide, and the others are
  /// there for the skin.
  void pruned(double ms, double near, double found) {
    const double frames = uses_ + 1;
    uses_ = 0, ++lived_;
    if (prunes_++ == 0) return;  // it touches memory for the first time
    const double extra = std::clamp(ms - use_ms(), 0.0, full_ms_) / frames,
                 of_skin = extra * std::max(0.0, near - found) / (near + 1);
    prune_ms_ = blend(prune_ms_, extra - of_skin);
    if (skin_ > 0) growth_ms_ = blend(growth_ms_, of_skin / skin_ * move_ / straying_);
  }
  /// The list is left, as a sphere has left its thick one.
  void ended() {
    if (move_ > 0 && skin_ > 0) straying_ = std::max(1.0, blend(straying_, lived_ * move_ / skin_));
  }
  void forget() { *this = {}; }

  /// Frames that a list made now should live.
  double life() const {
    const double saved = rebuild_ms() - use_ms(), growth = growth_ms_ > 0 ? growth_ms_ : full_ms_ / 50;
    return saved > 0 && growth > 0 ? std::clamp(std::sqrt(saved / growth), shortest, longest) : shortest;
  }
  /// The skin that it takes, of spheres that move by so much a frame at most; no more than `most`, nor than
  /// twice the last one, for what is known of that one says little of a much thicker one.
  double skin_for(double move, double most) const {
    if (skin_ > 0) most = std::min(most, 2 * skin_);
    return std::min(move * life() / straying_ * spare, most);
  }
  /// What a frame costs on average by lists of that skin.
  double mean_ms(double skin, double move) const {
    const double k = move > 0 ? std::clamp(skin / spare * straying_ / move, 1.0, life()) : life();
    return (rebuild_ms() + (k - 1) * use_ms()) / k + growth_ms_ * k + prune_ms_;
  }
  /// Nothing was measured that tells of the next frames.
  bool cold() const { return searches_ < cold_searches; }
  /// Guessed before the first list was made and used; not before a full search was measured.
  bool pays(double skin, double move) const { return !cold() && mean_ms(skin, move) < 0.9 * full_ms_; }
  /// A list that stands, whatever making it took.
  bool use_pays() const { return use_ms() + growth_ms_ * life() + prune_ms_ < 0.9 * full_ms_; }
  double full_ms() const { return full_ms_; }

 private:
  static constexpr unsigned cold_searches = 2;
  static constexpr double spare = 1.05;  ///< of a skin, for what is rounded
  static double blend(double old, double latest) { return old > 0 ? 0.7 * old + 0.3 * latest : latest; }
  double rebuild_ms() const { return made_ > 0 ? rebuild_ms_ : 2 * full_ms_; }
  double use_ms() const { return use_ms_ > 0 ? use_ms_ : full_ms_ / 4; }

  double full_ms_ = 0, rebuild_ms_ = 0, use_ms_ = 0, growth_ms_ = 0, move_ = 0, skin_ = 0;
  double prune_ms_ = 0;  ///< of a frame, on average
  double straying_ = 1;  ///< frames that a list lives, of those it would if all went straight on
  unsigned made_ = 0, searches_ = 0, prunes_ = 0;
  unsigned uses_ = 0, lived_ = 0;  ///< since the list was pruned; since it was made
};

}  // namespace catena
