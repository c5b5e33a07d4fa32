#pragma once
#include <cfenv>
#include <limits>

namespace catena {

/// While it lives, this thread and those that it starts compute in the floating-point environment that the
/// proofs suppose: to nearest, subnormal numbers kept. A program linked with -ffast-math flushes them to zero
/// from its start, others choose a rounding; they get back what they had.
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

  /// Tried rather than read, which takes nanoseconds and is the same for all processors; volatile, or the
  /// compiler would compute it in its own environment. A difference, as a product that is subnormal takes
  /// some processors 150 cycles; it is 0 where results are flushed, and counts as 0 where operands are.
  static bool stands() {
    volatile float least_normal = std::numeric_limits<float>::min(), greater = 1.5f * least_normal,
                   subnormal = greater - least_normal;
    return std::fegetround() == FE_TONEAREST && subnormal > 0;
  }

 private:
  bool changed_;
  std::fenv_t callers_{};
};

}  // namespace catena
