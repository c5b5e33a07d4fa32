#pragma once
#include <cfenv>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace catena::properties {

/// While it lives, this thread computes as in a program linked with -ffast-math, where the processor is
/// known: subnormal numbers are zero, read or written; rounded in this direction (FE_UPWARD, ...); and, as
/// under feenableexcept(), what makes infinity or no number ends the program.
class StrangeFloats {
 public:
  explicit StrangeFloats(int rounding) : rounding_(rounding) {
    std::fegetenv(&before_);
#ifdef __SSE__
    _mm_setcsr(_mm_getcsr() | flushes);
#endif
    std::fesetround(rounding);
#ifdef __GLIBC__
    std::feclearexcept(FE_ALL_EXCEPT);  // of the past; what stands would be trapped
    feenableexcept(trapped);
#endif
  }
  ~StrangeFloats() { std::fesetenv(&before_); }
  StrangeFloats(const StrangeFloats&) = delete;
  StrangeFloats& operator=(const StrangeFloats&) = delete;

  /// All of it is as it was made.
  bool stand() const {
#ifdef __SSE__
    if ((_mm_getcsr() & flushes) != flushes) return false;
#endif
#ifdef __GLIBC__
    if (fegetexcept() != trapped) return false;
#endif
    return std::fegetround() == rounding_;
  }

 private:
  static constexpr int trapped = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;
  static constexpr unsigned flushes = 0x8000 | 0x0040;  // results to zero, and subnormals read as zero
  const int rounding_;
  std::fenv_t before_;
};

}  // namespace catena::properties
