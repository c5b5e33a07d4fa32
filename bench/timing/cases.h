#pragma once
#include <string>
#include <vector>

#include "catena/bench/timing/trial.h"

namespace catena::bench {

/// One thing to time: SCENE/n:N/VARIANT/STAGE.
struct Case {
  WorkloadSpec spec;
  WorkloadFacts facts;
  VariantInfo variant;
  Stage stage;
  std::string name() const;
};

/// Every stage of every variant on every input, but for what is not worth measuring: variants that are not
/// available here, updates of inputs that do not move, build and update of all-pairs variants, and those
/// above `most_all_pairs` spheres (150,000 on a device). Opens each file once.
std::vector<Case> cases(const std::vector<WorkloadSpec>& inputs, const std::vector<VariantInfo>& variants,
                        std::uint32_t most_all_pairs = 20'000);

/// Keeps the cases whose name matches as Google Benchmark's filter would: a part of the name matches the
/// regular expression, or does not when it starts with '-'. Throws InputError on a malformed expression.
std::vector<Case> filtered(std::vector<Case> all, const std::string& filter);

}  // namespace catena::bench
