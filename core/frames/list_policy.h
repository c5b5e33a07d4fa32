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
/// pairs it holds, as the room around a sphere of radius r at most, (1 + skin / r)^3: these are found when it
/// is made and compared when it is pruned. With one rebuild, the mean of k frames is
///     (rebuild(skin) + (k - 1) use) / k + growth k + prune,   whose least is looked for among some k.
class CATENA_API ListPolicy {
 public:
  static constexpr double shortest = 2, longest = 64;  ///< lives, frames

  /// A full search of a frame took so long. The first ones touch memory for the first time, and are no
  /// measure of the next. One that took less than was thought says more than one that took more, while which
  /// something else may have run.
  void searched(double ms) {
    full_ms_ = searches_ < cold_searches ? ms
               : ms < full_ms_           ? blend(ms, full_ms_)
                                         : blend(full_ms_, std::min(ms, 2 * full_ms_));
    ++searches_;
  }
  /// A search of thicker spheres took so long; one of the frame itself takes less.
  void searched_thicker(double ms) {
    if (!cold()) full_ms_ = std::min(full_ms_, ms);
  }
  /// The chain has so many spheres: what looking at each takes is guessed until it was measured.
  void expect(double spheres) { spheres_ = spheres; }
  /// A list of spheres of about this radius, thicker by `skin`, was made and a frame answered by it, of a
  /// chain whose spheres were to move by `move` a frame.
  void rebuilt(double ms, double move, double skin, double radius) {
    // The first ones touch memory for the first time, too.
    const double guess = rebuild_ms(skin, radius),
                 latest = rebuild_ * (made_ < cold_searches ? std::min(ms, 1.5 * guess) : ms) / guess;
    rebuild_ = made_ == 0 ? latest : blend(rebuild_, latest);
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

  /// The skin that costs least, of spheres of about this radius that move by so much a frame at most; no more
  /// than the radius, nor than twice the last one, for what is known of that one says little of a much
  /// thicker one. A first one is thin, so that it costs little to learn what lists take.
  double skin_for(double move, double radius) const {
    const double most = std::min(radius, skin_ > 0 ? 2 * skin_ : first_skin * radius);
    double best = 0, least = 0;
    for (double k = shortest; k <= longest; k *= std::sqrt(2.0)) {
      const double skin = std::min(move * k / straying_ * spare, most), ms = mean_ms(skin, move, radius);
      if (k == shortest || ms < least) best = skin, least = ms;
    }
    return best;
  }
  /// What a frame costs on average by lists of that skin.
  double mean_ms(double skin, double move, double radius) const {
    const double k = life(skin, move);
    const double growth = growth_ms_ > 0 || radius <= 0 ? growth_ms_ * k : skin / radius * full_ms_ / 5;
    return (rebuild_ms(skin, radius) + (k - 1) * use_ms()) / k + growth + prune_ms_;
  }
  /// Nothing was measured that tells of the next frames.
  bool cold() const { return searches_ < cold_searches; }
  /// Guessed before the first list was made and used, which is done to learn if it may be worth it; not
  /// before a full search was measured.
  bool pays(double skin, double move, double radius) const {
    const double worth = made_ > 0 ? 0.9 : 1.3;
    return !cold() && use_ms() < 0.9 * full_ms_ && mean_ms(skin, move, radius) < worth * full_ms_;
  }
  /// A list that stands, whatever making it took.
  bool use_pays() const { return use_ms() + growth_ms_ * life(skin_, move_) + prune_ms_ < 0.9 * full_ms_; }
  double full_ms() const { return full_ms_; }
  /// No list was made but the last one, which touched memory for the first time.
  bool first_list() const { return made_ <= 1; }

 private:
  static constexpr unsigned cold_searches = 2;
  static constexpr double spare = 1.05;  ///< of a skin, for what is rounded
  static constexpr double first_skin = 0.5;
  static constexpr double sphere_ms = 5e-6;  ///< of a sphere that is looked at
  static double blend(double old, double latest) { return old > 0 ? 0.7 * old + 0.3 * latest : latest; }
  /// Frames that a list of that skin should live.
  double life(double skin, double move) const {
    return move > 0 ? std::clamp(skin / spare * straying_ / move, 1.0, longest) : longest;
  }
  double rebuild_ms(double skin, double radius) const {
    const double wider = radius > 0 ? 1 + skin / radius : 1;
    return rebuild_ * full_ms_ * (1 + 0.75 * wider * wider * wider);
  }
  double use_ms() const { return use_ms_ > 0 ? use_ms_ : std::max(full_ms_ / 4, sphere_ms * spheres_); }

  double full_ms_ = 0, use_ms_ = 0, growth_ms_ = 0, move_ = 0, skin_ = 0;
  double spheres_ = 0;
  double rebuild_ = 1;   ///< what making a list takes, of what it was guessed to
  double prune_ms_ = 0;  ///< of a frame, on average
  double straying_ = 1;  ///< frames that a list lives, of those it would if all went straight on
  unsigned made_ = 0, searches_ = 0, prunes_ = 0;
  unsigned uses_ = 0, lived_ = 0;  ///< since the list was pruned; since it was made
};

}  // namespace catena
