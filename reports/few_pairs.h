#pragma once
#include <functional>

#include "catena/bench/timing/workload.h"
#include "catena/reports/profile.h"

namespace catena::reports {

/// The profile whose sections are without those of its inputs that `make` refuses by bench::TooManyPairs,
/// which is said on standard error. They stay among what is timed: there each case says why it is not.
Profile with_few_pairs(Profile profile,
                       const std::function<void(const bench::WorkloadSpec&)>& make = bench::workload);

}  // namespace catena::reports
