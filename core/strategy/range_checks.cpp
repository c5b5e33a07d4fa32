#include "catena/core/strategy/range_checks.h"

#include <fmt/format.h>

namespace catena {

ParameterInfo range_parameter() {
  return {
      "range", "proved",
      "that no pair needs binary64 for its range is proved of the chain where it can be, or checked of each"};
}

RangeChecks::RangeChecks(const Parameters& parameters)
    : always_(parameters.choice("range", {"proved", "checked"}) == "checked") {}

Plan RangeChecks::plan() const {
  if (!some_) return {};
  return {
      {range_checks_step, idle_ && !always_,
       fmt::format("radii from {:.3g} to {:.3g}: the sums of two {} leave binary32's safe range{}", least_,
                   greatest_, idle_ ? "cannot" : "could", idle_ && always_ ? "; checked all the same" : "")}};
}

}  // namespace catena
