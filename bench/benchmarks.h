#pragma once

namespace catena::bench {

/// Registers scene/n/variant/stage with Google Benchmark for every variant that is available here. Each
/// compares its pairs with the exact reference in the same run before the first timing: a `robust` variant
/// that differs is an error, a rounded one reports `missing` and `invented`.
///
/// Stages: `build` and `find` as the variant times them (CUDA events on a device), `whole` the wall time
/// around both with every transfer.
void register_benchmarks(bool flush_cache);

}  // namespace catena::bench
