#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/export.h"

namespace catena::parts {

/// How the spheres of a chain are shared out over parts, be they parts that one machine searches one after
/// the other or those of ranks.
enum class Order {
  measured,  ///< by space where in chain order more than an eighth of the chain would be near another part
  chain,     ///< consecutive spheres
  space
};

/// What users call them, the default first.
CATENA_API const std::vector<std::string>& order_names();
/// The order of one of these names; throws std::logic_error for another.
CATENA_API Order order_named(std::string_view name);

}  // namespace catena::parts
