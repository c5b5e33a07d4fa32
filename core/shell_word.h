#pragma once
#include <string>
#include <string_view>

namespace catena {

/// Text as one word of a command that a reader may copy into a POSIX shell: as it is where no character of it
/// means anything there, else in quotes. The same as Python's shlex.quote. O(size).
std::string shell_word(std::string_view text);

}  // namespace catena
