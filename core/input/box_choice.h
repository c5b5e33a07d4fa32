#pragma once
#include <string>

#include "catena/core/input/input.h"
#include "catena/core/readers/reader.h"

namespace catena {

/// Makes `curves.boxes` those that repeat space: the file's, those of the options, or none, with a warning
/// where a box of the file is left out that is not said to repeat space. `name` is the file, for errors.
/// Throws InputError when the options ask for a box that the file does not have, and when there is one that
/// repeats space and the caller does not heed boxes.
void choose_boxes(CurveFile& curves, const InputOptions& options, const std::string& name);

/// The same of a scene, which has no box of its own.
std::vector<PeriodicBox> boxes_of_scene(const InputOptions& options, const std::string& name);

}  // namespace catena
