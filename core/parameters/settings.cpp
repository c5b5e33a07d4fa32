#include "catena/core/parameters/settings.h"

#include <fmt/format.h>

#include "catena/core/error.h"

namespace catena {

std::vector<Setting> parse_settings(std::string_view owner, std::string_view text) {
  std::vector<Setting> settings;
  for (bool more = !text.empty(); more;) {
    const auto comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    const auto equals = item.find('=');
    if (item.empty()) throw InputError(fmt::format("{}: a comma has no key=value on one side of it", owner));
    if (equals == std::string_view::npos || equals == 0)
      throw InputError(fmt::format("{}: '{}' is not key=value", owner, item));
    settings.push_back({std::string(item.substr(0, equals)), std::string(item.substr(equals + 1))});
    more = comma != std::string_view::npos;
    if (more) text.remove_prefix(comma + 1);
  }
  return settings;
}

std::string text_of(const std::vector<Setting>& settings) {
  std::string text;
  for (const Setting& s : settings) text += (text.empty() ? "" : ",") + s.key + "=" + s.value;
  return text;
}

}  // namespace catena
