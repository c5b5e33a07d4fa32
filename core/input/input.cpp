#include "catena/core/input/input.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/input/box_choice.h"
#include "catena/core/input/curve_input.h"
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
  return !SceneRegistry::instance().contains(scene_name(spec)) &&
         (spec.find('/') != std::string::npos || ReaderRegistry::instance().knows(spec) ||
          std::filesystem::path(spec) == "." || std::filesystem::path(spec) == "..");
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
    input.animation = std::make_unique<FileFrames>(make_chain(std::move(curves), options), std::move(later));
  } else {
    input.boxes = boxes_of_scene(options, spec);
    input.animation = open_scene(spec, options);
  }
  return input;
}

}  // namespace catena
