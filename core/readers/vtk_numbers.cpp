#include "catena/core/readers/vtk_numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/text_lines.h"

namespace catena {
namespace {

using Kind = VtkNumbers::Kind;
using Type = VtkNumbers::Type;

std::optional<Type> type_named(const std::string& name) {
  if (name == "float") return Type{4, Kind::floating};
  if (name == "double") return Type{8, Kind::floating};
  if (name == "char" || name == "signed_char") return Type{1, Kind::signed_integer};
  if (name == "unsigned_char") return Type{1, Kind::unsigned_integer};
  if (name == "short") return Type{2, Kind::signed_integer};
  if (name == "unsigned_short") return Type{2, Kind::unsigned_integer};
  if (name == "int" || name == "vtkidtype")
    return Type{4, Kind::signed_integer};  // as VTK writes its ids here
  if (name == "unsigned_int") return Type{4, Kind::unsigned_integer};
  if (name == "long" || name == "vtktypeint64") return Type{8, Kind::signed_integer};
  if (name == "unsigned_long" || name == "vtktypeuint64") return Type{8, Kind::unsigned_integer};
  return std::nullopt;
}

}  // namespace

VtkNumbers::Type VtkNumbers::type_of(const std::string& name) const {
  const auto type = type_named(lower_case(name));
  if (!type) fail(fmt::format("{} is no type of numbers here; leave the array out", in_quotes(name)));
  return *type;
}

std::uint64_t VtkNumbers::count(const std::string& text, std::string_view what) const {
  const auto [value, problem] = parse_integer(text);
  if (!problem.empty()) fail(fmt::format("{} {} {}", what, in_quotes(text), problem));
  if (value < 0 || static_cast<std::uint64_t>(value) > fields_.size())
    fail(fmt::format("{} {} is not one that a file of {} bytes can have", what, value, fields_.size()));
  return static_cast<std::uint64_t>(value);
}

double VtkNumbers::real(Type type, std::string_view what) {
  if (ascii_) {
    const std::string_view text = fields_.word(what);
    const auto [value, problem] = parse_double(text);
    if (!problem.empty()) fail(fmt::format("{} {} {}", what, in_quotes(text), problem));
    return value;
  }
  if (type.kind != Kind::floating) return static_cast<double>(integer(type, what));
  return type.size == 4 ? double{fields_.raw_f32(what)} : fields_.raw_f64(what);
}

double VtkNumbers::coordinate(Type type, std::string_view what) {
  if (ascii_) {
    const std::string_view text = fields_.word(what);
    const auto [value, problem] = parse_coordinate(text);
    if (!problem.empty()) fail(fmt::format("{} {} {}", what, in_quotes(text), problem));
    return value;
  }
  const double value = real(type, what);
  if (!std::isfinite(static_cast<float>(value)))
    fail(fmt::format("{} is {}, no finite 32-bit float", what, value));
  return value;
}

std::int64_t VtkNumbers::integer(Type type, std::string_view what) {
  if (ascii_) {
    const std::string_view text = fields_.word(what);
    const auto [value, problem] = parse_integer(text);
    if (!problem.empty()) fail(fmt::format("{} {} {}", what, in_quotes(text), problem));
    return value;
  }
  if (type.kind == Kind::floating) fail(fmt::format("{} is of a floating type", what));
  const std::uint64_t bits = fields_.unsigned_of(type.size, what);
  const unsigned unused = 64 - 8 * type.size;
  return type.kind == Kind::unsigned_integer ? static_cast<std::int64_t>(bits)
                                             : static_cast<std::int64_t>(bits << unused) >> unused;
}

void VtkNumbers::skip(std::uint64_t values, Type type, const std::string& what) {
  if (!ascii_) return fields_.skip(values * type.size, what);
  for (std::uint64_t k = 0; k < values; ++k) fields_.word(what);
}

void VtkNumbers::fail(const std::string& reason) const {
  ascii_ ? fields_.fail_at_line(reason) : fields_.fail(reason);
}

}  // namespace catena
