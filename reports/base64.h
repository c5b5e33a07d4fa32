#pragma once
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>

namespace catena::reports {

/// The bytes of an array as base64 (RFC 4648, padded).
template <class T>
std::string base64(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  namespace it = boost::archive::iterators;
  using Encode = it::base64_from_binary<it::transform_width<const char*, 6, 8>>;
  const char* bytes = reinterpret_cast<const char*>(values.data());
  const std::size_t size = values.size_bytes();
  std::string text(Encode(bytes), Encode(bytes + size));
  text.append((3 - size % 3) % 3, '=');
  return text;
}

}  // namespace catena::reports
