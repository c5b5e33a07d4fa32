#include "catena/core/input/box_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/error.h"

namespace catena {
namespace {

[[noreturn]] void refuse_box(const std::string& name, const std::string& whose) {
  throw InputError(
      fmt::format("{}: {} repeats space, which this command does not know; --box none leaves it out, if it "
                  "is an option here, else of what is written by catena export FILE NEW.chain --box none",
                  name, whose));
}

std::string size_of(const PeriodicBox& box) {
  return fmt::format("{} x {} x {}", box.length[0], box.length[1], box.length[2]);
}

}  // namespace

void choose_boxes(CurveFile& curves, const InputOptions& options, const std::string& name) {
  if (options.box_from == BoxFrom::options) {
    curves.boxes = boxes_of_scene(options, name);
    return;
  }
  // "ff ff ff" of a dump, "b = 0 0 0": the file says that nothing repeats.
  if (std::ranges::none_of(curves.boxes, &PeriodicBox::repeats)) curves.boxes.clear();
  if (options.box_from == BoxFrom::file && curves.boxes.empty())
    throw InputError(fmt::format(
        "{}: has no box that repeats space, or none that is read; give one with --box X,Y,Z", name));
  if (options.box_from == BoxFrom::none || curves.boxes.empty()) return curves.boxes.clear();
  const bool repeats = options.box_from == BoxFrom::file || curves.box_is_periodic;
  const std::string size = size_of(curves.boxes[0]);
  if (repeats && !options.takes_box) refuse_box(name, fmt::format("the box of the file, {},", size));
  if (repeats) return;
  curves.warnings.push_back(fmt::format(
      "the box of the file, {}, is left out; {}", size,
      options.takes_box ? "--box file says that space repeats it" : "--box none says that it is to be"));
  curves.boxes.clear();
}

std::vector<PeriodicBox> boxes_of_scene(const InputOptions& options, const std::string& name) {
  if (options.box_from == BoxFrom::file)
    throw InputError(fmt::format("{}: a scene has no box; give one with --box X,Y,Z", name));
  if (options.box_from != BoxFrom::options) return {};
  if (!options.takes_box) refuse_box(name, fmt::format("the box of --box, {},", size_of(options.box)));
  return {options.box};
}

}  // namespace catena
