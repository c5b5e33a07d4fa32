#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace catena {

/// An object as one line of --json. Bytes that are no UTF-8, as a file's name may have them, become U+FFFD.
inline std::string json_line(const nlohmann::ordered_json& object) {
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace catena
