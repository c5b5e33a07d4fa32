#pragma once
/// What catena's headers ask of who compiles them; included before all else by those that do arithmetic, or
/// that an older standard would take amiss.
#include <cfloat>

#if __cplusplus < 202002L
#error "catena needs C++20"
#endif
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    __FINITE_MATH_ONLY__
#error \
    "catena cannot be compiled with -ffast-math or a part of it: its bounds hold for IEEE-754 arithmetic only"
#endif
static_assert(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16,
              "catena cannot be compiled for floats in wider registers (x87): its bounds hold for operations "
              "that are rounded one by one");
