#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/readers/table_columns.h"

namespace catena {

/// What the comment line of extended XYZ (ASE, OVITO) says: key=value, values with blanks in quotes.
struct ExtendedXyz {
  std::optional<TableColumns> columns;  ///< of Properties=name:type:count:...
  std::vector<std::string> unread;      ///< names of properties that are not read
  bool has_lattice = false;
};

/// The properties pos (3), radius, species and id are read; others take their columns. Throws InputError,
/// without a place, for Properties that cannot be understood or have no pos:R:3. A line without Properties
/// gives no columns.
ExtendedXyz parse_extended_xyz(std::string_view title);

}  // namespace catena
