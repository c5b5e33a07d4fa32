#pragma once
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace catena {

/// Names each number that is not finite, for which JSON has none: it would be written as null.
inline void name_infinite(nlohmann::ordered_json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) value = "infinite";
  if (value.is_structured())
    for (nlohmann::ordered_json& part : value) name_infinite(part);
}

/// An object as one line of --json. Bytes that are no UTF-8, as a file's name may have them, become U+FFFD.
inline std::string json_line(nlohmann::ordered_json object) {
  name_infinite(object);
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace catena
