#pragma once
#include <string>
#include <string_view>

namespace catena {

/// Appends a cell of a CSV file (RFC 4180): in quotes where its text could be taken for something else, with
/// the quotation marks in it doubled.
inline void append_csv_cell(std::string& line, std::string_view text) {
  constexpr std::string_view blanks = " \v\f";  // which readers take off a cell's ends
  const bool plain = text.find_first_of(",;\t\"#\r\n") == std::string_view::npos &&
                     (text.empty() || (blanks.find(text.front()) == std::string_view::npos &&
                                       blanks.find(text.back()) == std::string_view::npos));
  if (plain) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) line.append(c == '"' ? 2 : 1, c);
  line += '"';
}

}  // namespace catena
