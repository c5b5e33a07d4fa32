#include "catena/core/commands/frame_option.h"

#include <fmt/format.h>

#include <charconv>

#include "catena/core/commands/command_line.h"
#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"

namespace catena {

void FrameOption::add_to(OptionParser& app) {
  app.add_option("--frame", text_, "Frame of an animated input, from 0, or all").type_name("F|all");
}

void FrameOption::check(const std::vector<std::string>& specs, const InputOptions& options) const {
  if (specs.size() < 2 || text_ == "0" || text_ == "all") return;  // which every input has
  for (const std::string& spec : specs)
    if (!is_standard_input(spec)) of(open_input(spec, options));
}

std::pair<std::uint32_t, std::uint32_t> FrameOption::of(const Input& input) const {
  return of(input.name, input.animation->frames());
}

std::pair<std::uint32_t, std::uint32_t> FrameOption::of(const std::string& name, std::uint32_t frames) const {
  if (text_ == "all") return {0, frames};
  std::uint32_t frame = 0;
  const char* end = text_.data() + text_.size();
  const auto parsed = std::from_chars(text_.data(), end, frame);
  if (parsed.ec != std::errc{} || parsed.ptr != end)
    throw InputError(fmt::format("--frame {}: must be a frame number from 0, or all", text_));
  if (frame >= frames)
    throw InputError(fmt::format("{} has {} frame{}, from 0; there is no frame {}", name, frames,
                                 frames == 1 ? "" : "s", frame));
  return {frame, frame + 1};
}

}  // namespace catena
