#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/export.h"

namespace catena {

/// "; did you mean 'path1'?" for the known name that is a slip of the pen away from what was written: up to
/// one edit in three characters, upper and lower case alike; else empty. To be put behind a message.
CATENA_API std::string did_you_mean(std::string_view written, const std::vector<std::string>& known);

}  // namespace catena
