#include "catena/core/readers/extended_xyz.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/text_lines.h"

namespace catena {
namespace {

using Role = TableColumns::Role;

/// Takes the next `key=value` or word off the line; the value without its quotes, none of a word.
std::pair<std::string, std::optional<std::string_view>> take_item(std::string_view& line) {
  constexpr std::string_view blanks = " \t";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::size_t key_end = std::min(line.find_first_of(" \t="), line.size());
  const std::string key = lower_case(line.substr(0, key_end));
  line.remove_prefix(key_end);
  if (!line.starts_with('=')) return {key, std::nullopt};
  line.remove_prefix(1);
  const bool quoted = line.starts_with('"');
  if (quoted) line.remove_prefix(1);
  const std::size_t end = std::min(quoted ? line.find('"') : line.find_first_of(blanks), line.size());
  const std::string_view value = line.substr(0, end);
  line.remove_prefix(std::min(end + (quoted ? 1 : 0), line.size()));
  return {key, value};
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

void read_properties(std::string_view text, ExtendedXyz& found) {
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
  while (!title.empty()) {
    const auto [key, value] = take_item(title);
    if (value && key == "properties") read_properties(*value, found);
    if (value && key == "lattice") found.has_lattice = true;
  }
  return found;
}

}  // namespace catena
