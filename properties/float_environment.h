#pragma once
#include <cfenv>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace catena::properties {

/// While it lives, this thread computes as in a program linked with -ffast-math, where the processor is
/// known: subnormal numbers are zero, read or written; and rounded in this direction (FE_UPWARD, ...).
class StrangeFloats {
 public:
  explicit StrangeFloats(int rounding) : rounding_(rounding) {
    std::fegetenv(&before_);
#ifdef __SSE__
    _mm_setcsr(_mm_getcsr() | flushes);
#endif
    std::fesetround(rounding);
  }
  ~StrangeFloats() { std::fesetenv(&before_); }
  StrangeFloats(const StrangeFloats&) = delete;
  StrangeFloats& operator=(const StrangeFloats&) = delete;

  /// All of it is as it was made.
  bool stand() const {
#ifdef __SSE__
    if ((_mm_getcsr() & flushes) != flushes) return false;
#endif
    return std::fegetround() == rounding_;
  }

 private:
  static constexpr unsigned flushes = 0x8000 | 0x0040;  // results to zero, and subnormals read as zero
  const int rounding_;
  std::fenv_t before_;
};

}  // namespace catena::properties
