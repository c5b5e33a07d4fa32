#pragma once

namespace catena {

// Steps of a plan that a strategy may leave out by itself, as plans and omissions name them.
inline constexpr const char* strand_table_step = "strand table";
inline constexpr const char* range_checks_step = "range checks";
inline constexpr const char* upload_step = "move of what lies on the device";

}  // namespace catena
