#include "catena/core/readers/extended_xyz.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/text_lines.h"

namespace catena {
namespace {

using Role = TableColumns::Role;

constexpr std::string_view blanks = " \t";

void skip_blanks(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
}

/// Where the value at the front of the line ends, behind its quote or bracket if it has one. Brackets may
/// stand in brackets.
std::size_t end_of_value(std::string_view line) {
  constexpr std::string_view openings = "\"'{[", closings = "\"'}]";
  const std::size_t kind = line.empty() ? std::string_view::npos : openings.find(line[0]);
  if (kind == std::string_view::npos) return std::min(line.find_first_of(blanks), line.size());
  std::size_t depth = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (at > 0 && line[at] == closings[kind] && --depth == 0) return at + 1;
    if (line[at] == openings[kind]) ++depth;
  }
  return line.size();
}

/// Takes the next `key=value` or word off the line; the value with its quotes, none of a word.
std::pair<std::string, std::optional<std::string_view>> take_item(std::string_view& line) {
  skip_blanks(line);
  const std::size_t key_end = std::min(line.find_first_of(" \t="), line.size());
  const std::string key = lower_case(line.substr(0, key_end));
  line.remove_prefix(key_end);
  std::string_view rest = line;
  skip_blanks(rest);
  if (!rest.starts_with('=')) return {key, std::nullopt};
  rest.remove_prefix(1);
  skip_blanks(rest);
  const std::string_view value = rest.substr(0, end_of_value(rest));
  line = rest.substr(value.size());
  return {key, value};
}

/// The words of a value, whatever quotes, brackets and commas stand around them.
std::vector<std::string_view> words_of(std::string_view value) {
  constexpr std::string_view between = " \t\"'{}[],";
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = value.find_first_not_of(between, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(value.find_first_of(between, at), value.size());
    words.push_back(value.substr(at, end - at));
    at = end;
  }
  return words;
}

void read_lattice(std::string_view value, ExtendedXyz& found) {
  const auto words = words_of(value);
  auto& edges = found.lattice.emplace();
  if (words.size() != edges.size())
    throw InputError(
        fmt::format("Lattice {} has {}, not 9", in_quotes(value), counted(words.size(), "number")));
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto [number, problem] = parse_double(words[k]);
    if (!problem.empty()) throw InputError(fmt::format("Lattice: {} {}", in_quotes(words[k]), problem));
    edges[k] = number;
  }
}

void read_periodic(std::string_view value, ExtendedXyz& found) {
  const auto words = words_of(value);
  if (words.size() != 3) throw InputError(fmt::format("pbc {} is not T or F three times", in_quotes(value)));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string word = lower_case(words[k]);
    const bool yes = word == "t" || word == "true" || word == "1";
    if (!yes && word != "f" && word != "false" && word != "0")
      throw InputError(fmt::format("pbc {} is not T or F three times", in_quotes(value)));
    found.periodic[k] = yes;
  }
}

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

void read_properties(std::string_view value, ExtendedXyz& found) {
  const auto words = words_of(value);
  const std::string_view text = words.size() == 1 ? words[0] : value;
  const auto parts = parts_of(text);
  if (parts.size() % 3 != 0)
    throw InputError(fmt::format("Properties {} is not name:type:count:...", in_quotes(text)));
  std::vector<Role> roles;
  for (std::size_t k = 0; k < parts.size(); k += 3) {
    const std::string name = lower_case(parts[k]);
    const auto [count, problem] = parse_integer(parts[k + 2]);
    constexpr std::int64_t most = 1000;
    if (!problem.empty() || count < 1 || count > most)
      throw InputError(fmt::format("Properties: {} of {} is no number of columns", in_quotes(parts[k + 2]),
                                   in_quotes(parts[k])));
    const bool real = parts[k + 1] == "R";
    if (name == "pos" && real && count == 3) {
      roles.insert(roles.end(), {Role::x, Role::y, Role::z});
      continue;
    }
    const Role role = count != 1                               ? Role::unread
                      : name == "radius" && real               ? Role::radius
                      : name == "species" || name == "element" ? Role::element
                      : name == "id"                           ? Role::id
                      : name == "strand"                       ? Role::strand
                      : name == "closed"                       ? Role::closed
                                                               : Role::unread;
    if (role == Role::unread) found.unread.push_back(in_quotes(parts[k]));
    roles.insert(roles.end(), static_cast<std::size_t>(count), role);
  }
  if (std::ranges::find(roles, Role::x) == roles.end())
    throw InputError(fmt::format("Properties {} has no pos:R:3", in_quotes(text)));
  found.columns = TableColumns(std::move(roles));
}

}  // namespace

ExtendedXyz parse_extended_xyz(std::string_view title) {
  ExtendedXyz found;
  std::vector<std::string> seen;
  while (!title.empty()) {
    const auto [key, value] = take_item(title);
    if (value && (key == "properties" || key == "lattice" || key == "pbc")) {
      if (std::ranges::find(seen, key) != seen.end())
        throw InputError(fmt::format("{} stands twice; keep one of them", in_quotes(key)));
      seen.push_back(key);
    }
    if (value && key == "properties") read_properties(*value, found);
    if (value && key == "lattice") read_lattice(*value, found);
    if (value && key == "pbc") read_periodic(*value, found);
  }
  return found;
}

}  // namespace catena
