#pragma once
#include <string>
#include <string_view>

namespace catena {

/// Text as it may be shown in a message of one line: line ends and tabs become blanks, other control
/// characters and bytes that are no UTF-8 '?'; words of more than 200 bytes keep their two ends, and text of
/// more than 4000 its start. O(size).
std::string one_line(std::string_view text);

}  // namespace catena
