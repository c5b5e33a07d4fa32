#pragma once
#include "catena/core/compiled_for.h"

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
