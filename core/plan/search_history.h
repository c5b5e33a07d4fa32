#pragma once
#include <algorithm>
#include <cstdint>

namespace catena {

/// What searches of one chain after another took a host, as far as it tells of the next one.
class SearchHistory {
 public:
  /// One of n spheres took `times` what is usual, and so much longer than a device would have.
  void add(std::uint32_t n, double times, double lost_ms) {
    if (n != n_) n_ = n, last_ = before_ = 0;
    before_ = last_, last_ = times;
    lost_ms_ += lost_ms;
  }
  /// What a sphere takes, of what it takes in a usual chain: the lesser of the last two searches, as a first
  /// one, or one that was disturbed, takes longer than those after it. 0: not known of so many spheres.
  double times(std::uint32_t n) const { return n == n_ ? std::min(last_, before_) : 0; }
  /// By all searches so far, of any number of spheres.
  double lost_ms() const { return lost_ms_; }

 private:
  std::uint32_t n_ = 0;
  double last_ = 0, before_ = 0, lost_ms_ = 0;
};

}  // namespace catena
