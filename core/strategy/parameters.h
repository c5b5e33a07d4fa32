#pragma once
#include <string>
#include <string_view>

#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"

namespace catena {

/// "name(key=value,...)" split into its two parts; parameters are empty when there are none.
struct CATENA_API StrategySpec {
  std::string name, parameters;
  static StrategySpec parse(std::string_view text);  ///< throws InputError on unbalanced parentheses
};

}  // namespace catena
