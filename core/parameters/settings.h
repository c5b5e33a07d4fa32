#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/export.h"

namespace catena {

/// A parameter and its value, as written.
struct CATENA_API Setting {
  std::string key, value;
  friend bool operator==(const Setting&, const Setting&) = default;
};

/// "key=value,key=value", or none in an empty text. Throws InputError, which begins with the owner, for what
/// is not key=value; also for nothing at all before, between or after commas.
CATENA_API std::vector<Setting> parse_settings(std::string_view owner, std::string_view text);

/// The same as they were written.
CATENA_API std::string text_of(const std::vector<Setting>& settings);

}  // namespace catena
