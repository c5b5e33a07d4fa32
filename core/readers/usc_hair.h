#pragma once
#include <filesystem>

#include "catena/core/readers/reader.h"

namespace catena {

/// True of a file whose first four bytes hold a 0, when unpacked, as those of no text do: then a .data is
/// hair of USC's form. False of what comes from standard input, of which --format usc tells.
bool may_be_usc_hair(const std::filesystem::path& file);

/// Hair of USC's database (USC-HairSalon) and of those that took its form: the number of strands, then for
/// each its number of points and three floats a point. Little-endian, no header, no radii. Throws InputError.
CurveFile read_usc_hair(const std::filesystem::path& file, const ReadOptions& options);

}  // namespace catena
