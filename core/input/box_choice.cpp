#include "catena/core/input/box_choice.h"

#include <fmt/format.h>

#include "catena/core/error.h"

namespace catena {

void choose_boxes(CurveFile& curves, const InputOptions& options, const std::string& name) {
  const bool has_box = !curves.boxes.empty();
  if (options.box_from == BoxFrom::file && !has_box)
    throw InputError(fmt::format("{}: has no box; give one with --box X,Y,Z", name));
  if (options.box_from == BoxFrom::options) curves.boxes = {options.box};
  if (options.box_from == BoxFrom::none) curves.boxes.clear();
  if (!has_box || options.box_from != BoxFrom::told) return;
  if (curves.box_is_periodic && options.takes_box) return;
  const auto [x, y, z] = curves.boxes[0].length;
  curves.warnings.push_back(fmt::format("the box of the file, {} x {} x {}, is left out; {}", x, y, z,
                                        options.takes_box ? "--box file says that space repeats it"
                                                          : "`catena detect` and `catena verify` take it"));
  curves.boxes.clear();
}

}  // namespace catena
