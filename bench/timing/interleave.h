#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace catena::bench {

/// Runs every one of `runs` once a round, in a fresh random order each round, until there are `most_rounds`
/// or, after at least three, `seconds` have passed. Each returns its milliseconds; result[k] are those of run
/// k in order.
std::vector<std::vector<double>> interleave(const std::vector<std::function<double()>>& runs,
                                            std::size_t most_rounds, double seconds, std::uint64_t seed);

}  // namespace catena::bench
