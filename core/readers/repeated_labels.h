#pragma once
#include <optional>
#include <string>

#include "catena/core/readers/reader.h"

namespace catena {

/// What to say of labels that name more than one sphere of a strand, or of spheres whose strand has no name,
/// as answers cannot be traced by them: how many, and the first. Nothing where each names one. O(n log n)
/// time and 8 bytes a sphere where labels are texts, O(runs log runs) where they are numbers.
std::optional<std::string> said_of_repeated_labels(const CurveFile& curves);

}  // namespace catena
