#include "catena/core/one_line.h"

#include <algorithm>
#include <cstddef>

namespace catena {
namespace {

bool continues(std::string_view text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;
}

/// How many bytes of UTF-8 start here, and print; 0 for none.
std::size_t printable(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
  const std::size_t size = lead >= 0xC2 && lead < 0xE0   ? 2
                           : lead >= 0xE0 && lead < 0xF0 ? 3
                           : lead >= 0xF0 && lead < 0xF5 ? 4
                                                         : 0;
  for (std::size_t k = 1; k < size; ++k)
    if (!continues(text, at + k)) return 0;
  const bool control = lead == 0xC2 && static_cast<unsigned char>(text[at + 1]) < 0xA0;
  return control ? 0 : size;
}

constexpr std::size_t longest = 200, shown_end = 80, longest_text = 4000;

/// Shortens the word that ends the text and starts at `first`, but not within a character.
void shorten(std::string& text, std::size_t first) {
  if (text.size() - first <= longest) return;
  std::size_t head = first + shown_end, tail = text.size() - shown_end;
  while (continues(text, head)) --head;
  while (continues(text, tail)) ++tail;
  text.replace(head, tail - head, "...");
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  std::size_t word = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = printable(text, at);
    const bool blank_byte = text[at] == '\n' || text[at] == '\r' || text[at] == '\t';
    line += size > 0 ? text.substr(at, size) : blank_byte ? " " : "?";
    at += std::max<std::size_t>(size, 1);
    if (line.back() != ' ' && at < text.size()) continue;
    const bool blank = line.back() == ' ';
    if (blank) line.pop_back();
    shorten(line, word);
    if (blank) line += ' ';
    word = line.size();
  }
  if (line.size() > longest_text) {
    std::size_t end = longest_text;
    while (continues(line, end)) --end;
    line.replace(end, line.size() - end, "...");
  }
  return line;
}

}  // namespace catena
