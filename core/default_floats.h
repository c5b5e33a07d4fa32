#pragma once
#include <cfenv>
#include <limits>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace catena {

/// While it lives, this thread and those that it starts compute in the floating-point environment that the
/// proofs suppose: to nearest, subnormal numbers kept, nothing trapped. A program linked with -ffast-math
/// flushes them to zero from its start, others choose a rounding, or have feenableexcept() end them where
/// infinity is computed, which is an answer here; they get back what they had.
class DefaultFloats {
 public:
  DefaultFloats() : changed_(!stands()) {
    if (!changed_) return;
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloats() {
    if (changed_) std::fesetenv(&callers_);
  }
  DefaultFloats(const DefaultFloats&) = delete;
  DefaultFloats& operator=(const DefaultFloats&) = delete;

  /// Read where it can be, in a nanosecond or two. Else tried, which is the same for all processors; but a
  /// result that is subnormal takes some of them 150 cycles. Volatile, or the compiler would compute it in
  /// its own environment.
  static bool stands() {
#ifdef __SSE__
    constexpr unsigned flushes_results = 0x8000, reads_as_zero = 0x0040, untrapped = _MM_MASK_MASK;
    return (_mm_getcsr() & (_MM_ROUND_MASK | flushes_results | reads_as_zero | untrapped)) ==
           (_MM_ROUND_NEAREST | untrapped);
#else
#ifdef __GLIBC__
    if (fegetexcept() != 0) return false;
#endif
    volatile float least_normal = std::numeric_limits<float>::min(),
                   subnormal = std::numeric_limits<float>::denorm_min();
    return std::fegetround() == FE_TONEAREST && subnormal > 0 && 0.5f * least_normal > 0;
#endif
  }

 private:
  bool changed_;
  std::fenv_t callers_{};
};

}  // namespace catena
