#include "catena/core/readers/table_columns.h"

#include <fmt/format.h>

#include <map>

#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/text_lines.h"

namespace catena {
namespace {

using Role = TableColumns::Role;

const std::map<std::string, Role, std::less<>>& names_of_roles() {
  static const std::map<std::string, Role, std::less<>> names{{"x", Role::x},
                                                              {"y", Role::y},
                                                              {"z", Role::z},
                                                              {"r", Role::radius},
                                                              {"radius", Role::radius},
                                                              {"d", Role::diameter},
                                                              {"diameter", Role::diameter},
                                                              {"id", Role::id},
                                                              {"element", Role::element},
                                                              {"strand", Role::strand},
                                                              {"chain", Role::strand},
                                                              {"chr", Role::strand},
                                                              {"closed", Role::closed}};
  return names;
}

}  // namespace

std::optional<Role> TableColumns::role_of(std::string_view name) {
  const auto& names = names_of_roles();
  const auto found = names.find(lower_case(trimmed(name.substr(0, name.find_first_of("[(")))));
  if (found == names.end()) return {};
  return found->second;
}

void TableColumns::require_one_unit(std::span<const std::string_view> names) {
  std::string_view told, teller;
  for (const std::string_view name : names) {
    const auto role = role_of(name);
    const std::size_t begin = name.find_first_of("[("), end = name.find_first_of("])");
    const bool of_length = role && (*role == Role::x || *role == Role::y || *role == Role::z ||
                                    *role == Role::radius || *role == Role::diameter);
    if (!of_length || begin == std::string_view::npos) continue;
    const std::string_view unit = trimmed(name.substr(begin + 1, end - begin - 1));
    if (told.empty()) told = unit, teller = name;
    if (unit != told)
      throw InputError(
          fmt::format("columns {} and {} tell different units", in_quotes(teller), in_quotes(name)));
  }
}

TableColumns::TableColumns(std::vector<Role> roles) : roles_(std::move(roles)) {
  for (std::size_t column = 0; column < roles_.size(); ++column) {
    if (roles_[column] == Role::unread) continue;
    auto& place = place_[static_cast<std::size_t>(roles_[column])];
    if (place) throw InputError(fmt::format("columns {} and {} mean the same", *place + 1, column + 1));
    place = column;
  }
  if (!has(Role::x) || !has(Role::y) || !has(Role::z)) throw InputError("the columns must name x, y and z");
  if (has(Role::radius) && has(Role::diameter))
    throw InputError("both a radius and a diameter column; keep one of them");
}

TableColumns TableColumns::of_option(const std::vector<std::string>& names) {
  std::vector<Role> roles;
  for (const std::string& name : names) {
    const auto role = name == "_" ? Role::unread : role_of(name);
    if (!role)
      throw InputError(fmt::format(
          "--columns: {} is no column; there are x, y, z, r, d, id, element, strand, chr, closed and _ "
          "for one that is not read",
          in_quotes(name)));
    roles.push_back(*role);
  }
  try {
    return TableColumns(std::move(roles));
  } catch (const InputError& error) {
    throw InputError(fmt::format("--columns: {}", error.what()));
  }
}

}  // namespace catena
