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
  explicit StrangeFloats(int rounding) {
    std::fegetenv(&before_);
#ifdef __SSE__
    constexpr unsigned flush_to_zero = 0x8000, subnormals_are_zero = 0x0040;
    _mm_setcsr(_mm_getcsr() | flush_to_zero | subnormals_are_zero);
#endif
    std::fesetround(rounding);
  }
  ~StrangeFloats() { std::fesetenv(&before_); }
  StrangeFloats(const StrangeFloats&) = delete;
  StrangeFloats& operator=(const StrangeFloats&) = delete;

 private:
  std::fenv_t before_;
};

}  // namespace catena::properties
