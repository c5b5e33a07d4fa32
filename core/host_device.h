#pragma once
#include <cfloat>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || __FINITE_MATH_ONLY__
#error "catena cannot be compiled with -ffast-math or a part of it: its bounds hold for IEEE-754 arithmetic only"
#endif
static_assert(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16,
              "catena cannot be compiled for floats in wider registers (x87): its bounds hold for operations "
              "that are rounded one by one");

/// Marks functions that both the host compiler and nvcc compile. Everything marked CATENA_HD is plain
/// IEEE-754 arithmetic without contraction, so host and device give the same bits.
#ifdef __CUDACC__
#define CATENA_HD __host__ __device__
#else
#define CATENA_HD
#endif

/// Marks the rare path of an inlined decision: kept out of line, so that it costs the common path no
/// registers.
#ifdef __CUDACC__
#define CATENA_COLD __host__ __device__ __noinline__
#else
#define CATENA_COLD __attribute__((noinline, cold))
#endif
