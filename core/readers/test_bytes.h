#pragma once
#include <algorithm>
#include <cstring>
#include <string>

namespace catena {

/// The bytes of a number behind those that are there.
template <class T>
void append(std::string& bytes, T value, bool big_endian = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big_endian) std::ranges::reverse(raw);
  bytes.append(raw, sizeof raw);
}

}  // namespace catena
