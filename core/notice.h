#pragma once
#include <string_view>

namespace catena {

/// "PROGRAM: WHAT" in one line (one_line) on standard error, beside the answer. Where that takes nothing, a
/// full disk or a closed pipe, nobody is told, and the answer is none the worse; fmt::print would throw, and
/// lose it.
void notice(std::string_view program, std::string_view what);

}  // namespace catena
