#include "catena/core/input/input.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/input/curve_input.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/readers/reader.h"
#include "catena/core/scenes/scene.h"

namespace catena {
namespace {

/// The single frame of a file.
class StillChain final : public Animation {
 public:
  explicit StillChain(Chain chain) : chain_(std::move(chain)) {}
  Chain frame(std::uint32_t) const override { return chain_; }

 private:
  Chain chain_;
};

bool is_file(const std::string& spec) {
  std::error_code ignored;
  const auto status = std::filesystem::status(spec, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_directory(status);
}

// A scene's parameters may contain a slash or a dot, its name cannot.
bool looks_like_file(const std::string& spec) {
  return !SceneRegistry::instance().contains(scene_name(spec)) &&
         (spec.find('/') != std::string::npos || ReaderRegistry::instance().knows(spec) ||
          std::filesystem::path(spec) == "." || std::filesystem::path(spec) == "..");
}

}  // namespace

Input open_input(const std::string& spec, const InputOptions& options) {
  if (spec.empty()) throw InputError("no input is named; give a scene or a file");
  Input input;
  input.name = spec;
  if (is_file(spec) || looks_like_file(spec)) {
    CurveFile curves = ReaderRegistry::instance().read(spec);
    input.warnings = std::move(curves.warnings);
    input.animation =
        std::make_unique<StillChain>(make_chain(std::move(curves), options, spec, input.warnings));
  } else {
    input.animation = open_scene(spec, options);
  }
  return input;
}

}  // namespace catena
