#pragma once
#include <string>
#include <type_traits>

#include "catena/core/strategy/plan.h"

namespace catena {

/// What with_tests_for decided, in range or not; empty for an arithmetic that has no range checks.
template <class Arithmetic>
Plan range_checks_plan(bool in_range) {
  if constexpr (std::is_same_v<Arithmetic, typename Arithmetic::InRange>) {
    return {};
  } else {
    return {{"range checks", in_range,
             std::string("the sums of two radii ") + (in_range ? "cannot" : "could") +
                 " leave binary32's safe range"}};
  }
}

}  // namespace catena
