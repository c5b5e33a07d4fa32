#pragma once
#include <cfenv>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace catena::properties {

/// While it lives, this thread computes as in a program linked with -ffast-math, where the processor is
/// known: subnormal numbers are zero, read or written; rounded in this direction (FE_UPWARD, ...); and, as
/// under feenableexcept(), what makes infinity or no number ends the program, where the processor has traps:
/// most ARM processors have none.
class StrangeFloats {
 public:
  explicit StrangeFloats(int rounding) : rounding_(rounding) {
    std::fegetenv(&before_);
#if defined(__SSE__)
    _mm_setcsr(_mm_getcsr() | flushes);
#elif defined(__aarch64__)
    std::fenv_t flushing = before_;
    flushing.__fpcr |= flushes;
    std::fesetenv(&flushing);
#endif
    std::fesetround(rounding);
#ifdef __GLIBC__
    std::feclearexcept(FE_ALL_EXCEPT);  // of the past; what stands would be trapped
    if (feenableexcept(divisions_and_overflows) != -1) trapped_ = divisions_and_overflows;
#endif
  }
  ~StrangeFloats() { std::fesetenv(&before_); }
  StrangeFloats(const StrangeFloats&) = delete;
  StrangeFloats& operator=(const StrangeFloats&) = delete;

  /// All of it is as it was made.
  bool stand() const {
#if defined(__SSE__)
    if ((_mm_getcsr() & flushes) != flushes) return false;
#elif defined(__aarch64__)
    std::fenv_t now;
    std::fegetenv(&now);
    if ((now.__fpcr & flushes) != flushes) return false;
#endif
#ifdef __GLIBC__
    if (fegetexcept() != trapped_) return false;
#endif
    return std::fegetround() == rounding_;
  }

 private:
  static constexpr int divisions_and_overflows = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;
#if defined(__SSE__)
  static constexpr unsigned flushes = 0x8000 | 0x0040;  // results to zero, and subnormals read as zero
#elif defined(__aarch64__)
  static constexpr unsigned flushes = 1u << 24;  // both
#endif
  const int rounding_;
  int trapped_ = 0;
  std::fenv_t before_;
};

}  // namespace catena::properties
