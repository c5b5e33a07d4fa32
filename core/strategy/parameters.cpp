#include "catena/core/strategy/parameters.h"

#include <fmt/format.h>

#include "catena/core/error.h"

namespace catena {

StrategySpec StrategySpec::parse(std::string_view text) {
  const auto open = text.find('(');
  if (open == std::string_view::npos && text.find(')') == std::string_view::npos) return {std::string(text), ""};
  if (open == std::string_view::npos || text.back() != ')' || text.find(')') != text.size() - 1)
    throw InputError(fmt::format("'{}': write parameters as name(key=value,...)", text));
  return {std::string(text.substr(0, open)), std::string(text.substr(open + 1, text.size() - open - 2))};
}

}  // namespace catena
