#include "catena/core/readers/base64.h"

#include <cstdint>

namespace catena {
namespace {

constexpr std::uint32_t no_letter = 64;

constexpr std::array<std::uint8_t, 256> values = [] {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::uint8_t, 256> table{};
  table.fill(no_letter);
  for (std::size_t k = 0; k < letters.size(); ++k)
    table[static_cast<unsigned char>(letters[k])] = static_cast<std::uint8_t>(k);
  return table;
}();

}  // namespace

bool Base64::decode_four() {
  std::uint32_t bits = 0;
  std::size_t letters = 0, padding = 0;
  while (letters + padding < 4) {
    if (text_.empty()) return false;
    const char c = text_.front();
    text_.remove_prefix(1);
    if (c == ' ' || ('\t' <= c && c <= '\r')) continue;
    if (c == '=') {
      ++padding;
      continue;
    }
    const std::uint32_t value = values[static_cast<unsigned char>(c)];
    if (value == no_letter || padding > 0) return false;
    bits = bits << 6 | value;
    ++letters;
  }
  if (letters < 2) return false;
  bits <<= 6 * padding;
  decoded_ = {static_cast<char>(bits >> 16), static_cast<char>(bits >> 8), static_cast<char>(bits)};
  used_ = 0, filled_ = letters - 1;
  return true;
}

bool Base64::read(std::size_t size, std::string& bytes) {
  for (std::size_t left = size; left > 0; --left) {
    if (used_ == filled_ && !decode_four()) return false;
    bytes += decoded_[used_++];
  }
  return true;
}

}  // namespace catena
