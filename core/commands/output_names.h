#pragma once
#include <string>
#include <vector>

#include "catena/core/readers/read_options.h"

namespace catena {

/// Throws InputError where a file that is to be written is one that is read, by whatever name, or is to be
/// written twice: one of the two would be lost. Devices and pipes lose nothing. Empty names are none.
void require_apart(const std::vector<std::string>& read, const std::vector<std::string>& written);

/// Of one input, be it a scene or a file: also what its reader opens beside it is read.
void require_apart(const std::string& input, const ReadOptions& reading,
                   const std::vector<std::string>& written);

}  // namespace catena
