#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/bench/timing/cases.h"
#include "catena/bench/timing/sampling.h"

namespace catena::bench {

struct Rounds {
  nlohmann::ordered_json context;     ///< Google Benchmark's
  nlohmann::ordered_json benchmarks;  ///< its rows, one a sample, in the order in which they ran
  std::size_t cases = 0;              ///< with at least one sample
  std::size_t narrow = 0;             ///< those of them whose interval became narrow enough
  std::size_t rounds = 0;
  std::vector<std::string> faults;  ///< variants that threw or answered wrongly: VARIANT on INPUT: what
  std::vector<std::string> not_reached;  ///< names of cases that the time did not suffice for
};

/// Takes a row as soon as it is measured.
using RowTaker = std::function<void(const nlohmann::ordered_json& row)>;

/// Measures with Google Benchmark, round by round. Each round takes one sample of every case that is not
/// done: inputs in a fresh random order, on each the variants in a fresh random order, each made anew and
/// warmed up, its stages after each other. Before its first sample a variant is held against the exact
/// reference, and beside each sample stands how fast the machine was (bench/timing/calibration.h). `earlier`
/// are the rows that a measurement of the same cases took before it was interrupted: they count, and come
/// first. Throws InputError when this program was built without Google Benchmark.
Rounds measure_in_rounds(const std::vector<Case>& cases, const Stopping& stopping, const RowTaker& taker = {},
                         const nlohmann::ordered_json& earlier = nlohmann::ordered_json::array());

}  // namespace catena::bench
