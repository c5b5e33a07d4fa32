#include "catena/core/readers/number_text.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace catena {
namespace {

constexpr std::string_view digits = "0123456789";

// from_chars takes a minus sign only.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return plus ? text.substr(1) : text;
}

// Of a number that from_chars finds out of range: too small rather than too large? Its decimal exponent
// tells.
bool is_tiny(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  const auto e = text.find_first_of("eE");
  const std::string_view mantissa = text.substr(0, e);
  std::int64_t exponent = 0;
  if (e != std::string_view::npos) {
    const std::string_view written = without_plus(text.substr(e + 1));
    const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), exponent);
    if (error != std::errc{}) return written.starts_with('-');
  }
  const auto point = std::min(mantissa.find('.'), mantissa.size());
  const auto leading = mantissa.find_first_of("123456789");
  if (leading == std::string_view::npos) return true;
  const auto place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(leading);
  return exponent < -place;
}

// Fortran may write the exponent of a double as D. `stop` is where a number without one ends. Empty where
// that is not so.
std::string fortran_with_e(std::string_view text, const char* stop) {
  const auto at = static_cast<std::size_t>(stop - text.data());
  if (at == 0 || at + 1 >= text.size() || (text[at] != 'D' && text[at] != 'd')) return {};
  std::string with_e(text);
  with_e[at] = 'e';
  return with_e;
}

template <class Real>
Parsed<Real> parse_real(std::string_view text, const char* type) {
  const std::string_view plain = without_plus(text);
  Real value = 0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error == std::errc::invalid_argument || end != plain.data() + plain.size()) {
    if (const std::string with_e = fortran_with_e(plain, end); !with_e.empty())
      return parse_real<Real>(with_e, type);
    return {0, "is not a number"};
  }
  if (error == std::errc::result_out_of_range) {
    if (is_tiny(plain)) return {plain.starts_with('-') ? -Real{0} : Real{0}, ""};
    return {0, std::string("is too large for ") + type};
  }
  if (!std::isfinite(value)) return {0, "is not a finite number"};
  return {value, ""};
}

}  // namespace

bool is_number(std::string_view text) { return parse_double(text).problem != "is not a number"; }

bool is_integer(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of(digits) == std::string_view::npos;
}

bool is_zero(std::string_view text) {
  const std::string_view mantissa = text.substr(0, text.find_first_of("eEdD"));
  return is_number(text) && mantissa.find_first_of("123456789") == std::string_view::npos;
}

Parsed<float> parse_float(std::string_view text) { return parse_real<float>(text, "a 32-bit float"); }
Parsed<double> parse_double(std::string_view text) { return parse_real<double>(text, "a 64-bit float"); }

Parsed<double> parse_coordinate(std::string_view text) {
  const Parsed<double> wide = parse_double(text);
  const float once_more = static_cast<float>(wide.value);
  // Rounded twice is rounded once unless the double lies midway between two floats.
  constexpr std::uint64_t dropped = (std::uint64_t{1} << 29) - 1, midway = std::uint64_t{1} << 28;
  const bool safe = std::isfinite(once_more) && std::abs(wide.value) >= std::numeric_limits<float>::min() &&
                    (std::bit_cast<std::uint64_t>(wide.value) & dropped) != midway;
  if (wide.problem.empty() && (safe || wide.value == 0)) return wide;
  const Parsed<float> nearest = parse_float(text);
  if (!nearest.problem.empty()) return {0, nearest.problem};
  const bool missed = once_more != nearest.value;
  return {missed ? std::nextafter(wide.value, double{nearest.value}) : wide.value, ""};
}

Parsed<std::int64_t> parse_integer(std::string_view text) {
  const std::string_view plain = without_plus(text);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error == std::errc::result_out_of_range) return {0, "is too large for a 64-bit integer"};
  if (error != std::errc{} || end != plain.data() + plain.size()) return {0, "is not a whole number"};
  return {value, ""};
}

}  // namespace catena
