#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/readers/table_columns.h"

namespace catena {

/// What the comment line of extended XYZ (ASE, OVITO) says: key=value, values with blanks in quotes or
/// brackets.
struct ExtendedXyz {
  std::optional<TableColumns> columns;             ///< of Properties=name:type:count:...
  std::vector<std::string> unread;                 ///< names of properties that are not read
  std::optional<std::array<double, 9>> lattice;    ///< the edges a, b and c of the box, one after the other
  std::array<bool, 3> periodic{true, true, true};  ///< along a, b and c, as pbc says; without it along all
};

/// The properties pos (3), radius, species, id, strand and closed are read; others take their columns. Throws
/// InputError, without a place, for Properties that cannot be understood or have no pos:R:3, and for a
/// Lattice or pbc that cannot. A line without Properties gives no columns.
ExtendedXyz parse_extended_xyz(std::string_view title);

}  // namespace catena
