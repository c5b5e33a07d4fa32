#include "catena/core/parts/order.h"

#include <algorithm>
#include <stdexcept>

#include "catena/core/never_destroyed.h"

namespace catena::parts {

const std::vector<std::string>& order_names() {
  static const auto& names = never_destroyed(std::vector<std::string>{"measured", "chain", "space"});
  return names;
}

Order order_named(std::string_view name) {
  const auto& names = order_names();
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) throw std::logic_error("no order of parts has this name");
  return static_cast<Order>(at - names.begin());
}

}  // namespace catena::parts
