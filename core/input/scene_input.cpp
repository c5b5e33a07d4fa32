#include "catena/core/input/scene_input.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/input/curve_input.h"
#include "catena/core/made_once.h"
#include "catena/core/parameters/settings.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/scenes/scene.h"

namespace catena {
namespace {

/// A scene with another exclusion rule. Its arc lengths are those of frame 0, as a moved chain keeps its
/// neighbours.
class WithExclusion final : public Animation {
 public:
  WithExclusion(std::unique_ptr<Animation> scene, const InputOptions& options)
      : scene_(std::move(scene)), options_(options) {
    chosen_exclusion(options_, {});  // refused before a sphere is made
  }
  std::uint32_t frames() const override { return scene_->frames(); }
  Chain frame(std::uint32_t f) const override {
    const Chain& rest = rest_.by([&] {
      Chain first = scene_->frame(0);
      const Strands strands = first.strands();
      Exclusion exclusion = chosen_exclusion(options_, first.exclusion());
      return Chain(std::move(first).release(), strands, std::move(exclusion));
    });
    return f == 0 ? rest : rest.moved(scene_->frame(f).release());
  }
  std::optional<ChainByStretches> in_stretches(std::uint32_t f) const override {
    auto stretches = scene_->in_stretches(f);
    if (stretches) stretches->exclusion = chosen_exclusion(options_, stretches->exclusion);
    return stretches;
  }
  std::int64_t shift(std::uint32_t f) const override { return scene_->shift(f); }

 private:
  std::unique_ptr<Animation> scene_;
  InputOptions options_;
  MadeOnce<Chain> rest_;
};

class OneFrame final : public Animation {
 public:
  OneFrame(std::unique_ptr<Animation> scene, std::uint32_t frame) : scene_(std::move(scene)), frame_(frame) {}
  Chain frame(std::uint32_t) const override { return scene_->frame(frame_); }
  std::optional<ChainByStretches> in_stretches(std::uint32_t) const override {
    return scene_->in_stretches(frame_);
  }

 private:
  std::unique_ptr<Animation> scene_;
  std::uint32_t frame_;
};

/// Takes frame=F out of the spec of a scene.
std::optional<std::int64_t> take_frame(std::string& spec) {
  const auto colon = spec.find(':');
  if (colon == std::string::npos || !SceneRegistry::instance().contains(scene_name(spec))) return {};
  std::optional<std::int64_t> frame;
  std::vector<Setting> rest;
  for (Setting& setting :
       parse_settings("scene " + scene_name(spec), std::string_view(spec).substr(colon + 1))) {
    if (setting.key != "frame") {
      rest.push_back(std::move(setting));
      continue;
    }
    if (frame) throw InputError(fmt::format("{}: frame is given twice", spec));
    const auto [number, problem] = parse_integer(setting.value);
    if (!problem.empty() || number < 0 || number > 0xFFFFFFFF)
      throw InputError(fmt::format("{}: frame={} must be a frame number from 0", spec, setting.value));
    frame = number;
  }
  if (frame) spec = rest.empty() ? scene_name(spec) : fmt::format("{}:{}", scene_name(spec), text_of(rest));
  return frame;
}

}  // namespace

std::string scene_name(const std::string& spec) { return spec.substr(0, spec.find(':')); }

std::uint32_t written_frame(const std::string& spec) {
  std::string rest = spec;
  return static_cast<std::uint32_t>(take_frame(rest).value_or(0));
}

std::unique_ptr<Animation> open_scene(const std::string& spec, const InputOptions& options) {
  if (options.radius || options.radius_half_spacing)
    throw InputError(
        fmt::format("{}: a scene has radii of its own; set its parameter radius=R instead", spec));
  if (options.closed)
    throw InputError(
        fmt::format("{}: a scene knows which of its strands are closed; leave out --closed", spec));
  const ReadOptions& reading = options.reading;
  if (!reading.columns.empty() || !reading.atom.empty() || !reading.array.empty() ||
      !reading.topology.empty() || reading.recentre)
    throw InputError(fmt::format(
        "{}: --columns, --atom, --array, --topology, --recentre and --origin are for files, not for scenes",
        spec));
  std::string scene_spec = spec;
  const auto frame = take_frame(scene_spec);
  auto animation = SceneRegistry::instance().open(scene_spec);
  if (frame && *frame >= animation->frames())
    throw InputError(fmt::format("{}: the scene has the frames 0 to {}", spec, animation->frames() - 1));
  if (options.window || options.arc_window)
    animation = std::make_unique<WithExclusion>(std::move(animation), options);
  if (frame) animation = std::make_unique<OneFrame>(std::move(animation), static_cast<std::uint32_t>(*frame));
  return animation;
}

}  // namespace catena
