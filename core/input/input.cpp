#include "catena/core/input/input.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/box_choice.h"
#include "catena/core/input/curve_input.h"
#include "catena/core/input/naming.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"
#include "catena/core/scenes/scene.h"

namespace catena {
namespace {

/// The frames of a file; neighbours are those of the first.
class FileFrames final : public Animation {
 public:
  FileFrames(Chain first, std::vector<std::vector<Sphere>> later)
      : first_(std::move(first)), later_(std::move(later)) {}
  std::uint32_t frames() const override { return static_cast<std::uint32_t>(later_.size() + 1); }
  Chain frame(std::uint32_t f) const override { return f == 0 ? first_ : first_.moved(later_[f - 1]); }

 private:
  Chain first_;
  std::vector<std::vector<Sphere>> later_;
};

bool is_file(const std::string& spec) {
  std::error_code ignored;
  const auto status = std::filesystem::status(spec, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_directory(status);
}

// A scene's parameters may contain a slash or a dot, its name cannot.
bool looks_like_file(const std::string& spec, const ReadOptions& options) {
  if (is_standard_input(spec) || !options.format.empty()) return true;
  std::error_code none;
  return !SceneRegistry::instance().contains(scene_name(spec)) &&
         (spec.find('/') != std::string::npos || ReaderRegistry::instance().knows(spec) ||
          std::filesystem::is_directory(spec, none));
}

std::string said_of(const Thinning& thinning) {
  const std::string own = fmt::format(
      "{:.3g} of a radius is lost between spheres that are neighbours in the input", thinning.own);
  if (thinning.kept.size() == thinning.spheres) return "every sphere is kept for this tolerance; " + own;
  return fmt::format("{} of {} are kept; without the others the tube lacks {:.3g} of a radius at most{}",
                     thinning.kept.size(), counted(thinning.spheres, "sphere"), thinning.lost,
                     thinning.own > thinning.tolerance ? "; " + own : "");
}

void leave_out(Input& input, double tolerance) {
  Thinning thinning = thin(*input.animation, input.joints, tolerance, input.boxes);
  input.animation = thinned(std::move(input.animation), thinning);
  if (input.labels.size() > 0) {
    input.labels = input.labels.chosen(thinning.kept);
  } else {
    for (const std::uint32_t sphere : thinning.kept) input.labels.add(std::int64_t{sphere});
  }
  for (Pair& joint : input.joints) joint = {thinning.place_of(joint.i), thinning.place_of(joint.j)};
  input.warnings.push_back(said_of(thinning));
  input.thinning = std::move(thinning);
}

}  // namespace

Input open_input(const std::string& spec, const InputOptions& options) {
  if (spec.empty()) throw InputError("no input is named; give a scene or a file");
  Input input;
  input.name = spec;
  if (is_file(spec) || looks_like_file(spec, options.reading)) {
    CurveFile curves = ReaderRegistry::instance().read(spec, options.reading);
    complete(curves, options, spec);
    choose_boxes(curves, options, spec);
    input.warnings = std::move(curves.warnings);
    input.labels = std::move(curves.labels);
    input.rounding = curves.rounding.greatest_error();
    input.boxes = curves.boxes;
    input.joints = curves.joints;
    auto later = std::move(curves.later_frames);
    Chain chain = naming(spec, [&] { return make_chain(std::move(curves), options); });
    input.animation = std::make_unique<FileFrames>(std::move(chain), std::move(later));
  } else {
    input.boxes = boxes_of_scene(options, spec);
    input.animation = open_scene(spec, options);
  }
  if (options.tolerance) leave_out(input, *options.tolerance);
  return input;
}

void check_inputs(const std::vector<std::string>& specs, const InputOptions& options) {
  if (specs.size() < 2) return;
  for (const std::string& spec : specs)
    if (!is_standard_input(spec)) open_input(spec, options);
}

}  // namespace catena
