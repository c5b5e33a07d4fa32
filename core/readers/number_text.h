#pragma once
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

namespace catena {

/// Decimal text as numbers, whatever the locale. A leading '+' is accepted, and D for the E of an exponent,
/// as Fortran writes it; blanks around the number are not.

/// True when the whole text has the form of a number: also one that is out of range, infinite or NaN.
bool is_number(std::string_view text);

/// True for an optional sign and digits, nothing else.
bool is_integer(std::string_view text);

/// A number and, when there is none, the reason: "is not a number", "does not fit into ...".
template <class T>
struct Parsed {
  T value{};
  std::string problem;  ///< empty when value is good
};

/// True for a number of which no digit but those of an exponent is other than 0: what else reads as 0 is less
/// than the least that the type has.
bool is_zero(std::string_view text);

/// The nearest value of the type, rounded once, so that the shortest text of a float reads as that float.
/// Less than the least positive value rounds to it or to zero; beyond the greatest is a problem, and so are
/// infinity and NaN.
Parsed<float> parse_float(std::string_view text);
/// The same of a double.
Parsed<double> parse_double(std::string_view text);

/// A coordinate that is yet to be rounded to binary32: the nearest double, or where rounding that once more
/// would miss the nearest float, the double beside it that does not. Beyond the greatest float is a problem.
Parsed<double> parse_coordinate(std::string_view text);

/// A whole number, signed, of 64 bits; anything else is a problem.
Parsed<std::int64_t> parse_integer(std::string_view text);

/// Appends the shortest text that reads as exactly this number. Not fmt: the standard promises it of
/// to_chars.
template <class Number>
void append_shortest(std::string& text, Number number) {
  char digits[64];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, number);
  text.append(digits, end);
}

}  // namespace catena
