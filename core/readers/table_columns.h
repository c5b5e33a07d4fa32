#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace catena {

/// What each column of a table of points is.
class TableColumns {
 public:
  enum class Role { unread, x, y, z, radius, diameter, id, element, strand, closed };

  /// What a column of this name is: x, y, z, r or radius, d or diameter, id, element, strand or chain or
  /// chr, closed; upper case, too, and with a unit in brackets after it. Nothing for another name.
  static std::optional<Role> role_of(std::string_view name);

  /// Throws InputError, without a place, where two of the columns named so, of a coordinate or a radius, tell
  /// different units, as "x (mm)" and "r [um]" do.
  static void require_one_unit(std::span<const std::string_view> names);

  TableColumns() = default;
  /// Throws InputError, without a place, unless there is one column of x, of y and of z, and at most one of
  /// each other role, radius and diameter being one; unread columns may be many.
  explicit TableColumns(std::vector<Role> roles);
  /// Of the names after --columns, where `_` is a column that is not read. Throws InputError, also for other
  /// names.
  static TableColumns of_option(const std::vector<std::string>& names);

  std::size_t size() const { return roles_.size(); }
  bool has(Role role) const { return place_[static_cast<std::size_t>(role)].has_value(); }
  /// The number of the column that has this role; it must have one.
  std::size_t place(Role role) const { return *place_[static_cast<std::size_t>(role)]; }
  bool has_radii() const { return has(Role::radius) || has(Role::diameter); }

 private:
  std::vector<Role> roles_;
  std::array<std::optional<std::size_t>, 10> place_{};
};

}  // namespace catena
