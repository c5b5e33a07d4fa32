#pragma once
#include <span>
#include <string_view>

#include "catena/core/readers/table_columns.h"
#include "catena/core/readers/text_lines.h"

namespace catena {

/// What the columns of a table without a header are, by a row of it: three numbers, or a chemical element and
/// three numbers. Throws InputError for anything else, as it can be read in several ways, with the ways to
/// say which; and for what is no number. `counted`: the table is XYZ, where any word in front is an element,
/// by the format.
TableColumns columns_of_row(std::span<const std::string_view> row, bool counted, const TextLines& lines);

}  // namespace catena
