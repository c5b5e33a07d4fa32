#pragma once
#include <type_traits>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/step_names.h"

namespace catena {

/// What with_tests_for decided, in range or not; empty for an arithmetic that has no range checks.
template <class Arithmetic>
Plan range_checks_plan(bool in_range) {
  if constexpr (std::is_same_v<Arithmetic, typename Arithmetic::InRange>) {
    return {};
  } else {
    return {{range_checks_step, in_range,
             std::string("the sums of two radii ") + (in_range ? "cannot" : "could") +
                 " leave binary32's safe range"}};
  }
}

/// "range": proved or checked.
CATENA_API ParameterInfo range_parameter();

/// Which tests a search takes: those without range checks where the chain proves them idle, unless it is told
/// to check all the same; and what a plan says of that. A pair that fails the check falls back to binary64.
class CATENA_API RangeChecks {
 public:
  explicit RangeChecks(const Parameters& parameters);

  /// As with_tests_for.
  template <class Arithmetic, class Search>
  void with_tests_for(const ChainView& chain, const Search& search) {
    some_ = !std::is_same_v<Arithmetic, typename Arithmetic::InRange>;
    idle_ = in_range<Arithmetic>(chain);
    least_ = chain.extent.least_radius, greatest_ = chain.extent.greatest_radius;
    if (idle_ && !always_)
      search(typename Arithmetic::InRange{});
    else
      search(Arithmetic{});
  }

  /// Of the last search; empty for an arithmetic that has none, and before the first.
  Plan plan() const;

 private:
  const bool always_;
  bool some_ = false, idle_ = false;
  float least_ = 0, greatest_ = 0;  ///< radii
};

}  // namespace catena
