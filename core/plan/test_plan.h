#pragma once
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "catena/core/plan/search_plan.h"

// Machines whose costs are made up, and what is planned on them.
namespace catena::test {

/// All pairs are cheaper up to 40 spheres, the device from 10,000 on.
inline Machine machine() {
  return {{{"pairs", {{.sphere_pair_ns = 2}}, false, true},
           {"tree", {{.fixed_us = 1.2, .sphere_ns = 9}}},
           {"slow tree", {{.fixed_us = 5, .sphere_ns = 9}}},
           {"device", {{.fixed_us = 82, .sphere_ns = 0.92}}, true}},
          "a test",
          {}};
}

inline std::string chosen(std::uint32_t n, const std::vector<std::string>& keep = {},
                          const Machine& of = machine()) {
  return SearchPlan(n, {}, of, Omissions::without(keep)).variant();
}

inline const Decision& step(const Plan& plan, const std::string& name) {
  const auto found = std::ranges::find(plan, name, &Decision::step);
  if (found == plan.end()) throw std::logic_error("no step " + name);
  return *found;
}

/// One search that knows threads, of which half the work can be shared out.
inline Machine sixteen_cores() {
  Machine of = machine();
  of.costs = {{"Hybrid", {{.fixed_us = 1, .sphere_ns = 10}, 0.5, 40}}};
  of.cores = 16;
  return of;
}

}  // namespace catena::test
