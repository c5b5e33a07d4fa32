#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace catena {

/// Where a row of the section Atoms has what is read of it, by the style of the atoms.
struct LammpsAtomStyle {
  std::string_view name;
  std::size_t columns;  ///< that a row has; three image flags may follow
  std::size_t x;        ///< y and z follow
  std::optional<std::size_t> molecule{}, diameter{};
  bool more_columns = false;  ///< at the end, as the style or its sub-styles need them

  bool fits(std::size_t row) const {
    return row == columns || row == columns + 3 || (more_columns && row > columns);
  }
};

/// All styles of https://docs.lammps.org/read_data.html but those whose atoms are no points (ellipsoids,
/// lines, triangles and bodies are taken by their centres).
std::span<const LammpsAtomStyle> lammps_atom_styles();

}  // namespace catena
