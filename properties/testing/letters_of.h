#pragma once
#include <cctype>
#include <string>

namespace catena::properties {

/// What GoogleTest takes as the name of a parameter: its letters and digits.
inline std::string letters_of(std::string name) {
  std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
  return name;
}

}  // namespace catena::properties
