#include "catena/core/ranks/rank_input.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <tuple>

#include "catena/core/commands/show_warnings.h"
#include "catena/core/input/naming.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/ranks/box_search.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/part_file.h"
#include "catena/core/readers/text_lines.h"

namespace catena::ranks {

namespace {

/// Whether each rank reads its own part: what the options would change of the file, or mean nothing for it,
/// rank 0 does for all, or refuses.
bool in_parts(const std::string& spec, const InputOptions& options) {
  const bool as_it_is = !options.window && !options.arc_window && !options.closed && !options.radius &&
                        !options.radius_half_spacing && options.reading == ReadOptions() &&
                        options.box_from != BoxFrom::file && options.box_from != BoxFrom::options;
  std::error_code unknown;
  return as_it_is && lower_case(spec).ends_with(".catena") && std::filesystem::is_regular_file(spec, unknown);
}

}  // namespace

RankInput::RankInput(Communicator& ranks, const std::string& spec, const InputOptions& options,
                     const Open& open)
    : ranks_(ranks), spec_(spec) {
  // Rank 0 decides, as the others may not see the file.
  source_ = all_gather_value(ranks, ranks.rank() == 0 ? decide(options) : Source{}).front();
  if (source_ == Source::file) file_.emplace(open(spec));
  if (source_ == Source::scene && !input_) input_ = open_input(spec, options);
}

RankInput::Source RankInput::decide(const InputOptions& options) {
  if (in_parts(spec_, options)) return Source::file;
  input_ = open_input(spec_, options);
  show_warnings(*input_);
  if (!input_->boxes.empty()) return Source::rank_0;
  const auto scene = input_->animation->in_stretches(0);
  const bool alone =
      scene && scene->exclusion.rule == Exclusion::Rule::index_window && scene->exclusion.extra_pairs.empty();
  return alone ? Source::scene : Source::rank_0;
}

std::pair<std::uint32_t, std::uint32_t> RankInput::frames(const FrameOption& option) const {
  struct Frames {
    std::uint32_t first, last;
  } frames{0, 0};
  if (ranks_.rank() == 0)
    std::tie(frames.first, frames.last) = input_ ? option.of(*input_) : option.of(spec_, 1);
  const Frames told = all_gather_value(ranks_, frames).front();
  return {told.first, told.last};
}

NamedPart RankInput::part(std::uint32_t frame) const {
  if (source_ == Source::file) return {read_part(ranks_, *file_), {}};
  const auto start = [&](std::uint32_t n, unsigned rank) {
    return static_cast<std::uint32_t>(even_start(n, ranks_.size(), rank));
  };
  if (source_ == Source::scene) {
    const auto scene = input_->animation->in_stretches(frame);
    const unsigned rank = ranks_.rank();
    return {part_of(*scene, start(scene->size, rank), start(scene->size, rank + 1)), {}};
  }
  Chain chain;
  if (input_) chain = input_->animation->frame(frame);
  return scatter(ranks_, [&](unsigned rank) {
    return named_part_of(chain, input_->labels, start(chain.size(), rank), start(chain.size(), rank + 1));
  });
}

std::optional<PeriodicBox> RankInput::box(std::uint32_t frame) const {
  struct Told {
    std::uint64_t repeats = 0;  // as wide as the others, so that no byte of it is undefined
    PeriodicBox box{};
  } told;
  if (input_)
    if (const PeriodicBox* const box = box_of(input_->boxes, frame)) told = {1, *box};
  told = all_gather_value(ranks_, told).front();
  if (told.repeats == 0) return {};
  return told.box;
}

std::optional<Chain> RankInput::whole(std::uint32_t frame) const {
  if (!input_ || ranks_.rank() != 0) return {};
  return input_->animation->frame(frame);
}

std::string RankInput::name_of(std::uint32_t frame) const {
  return fmt::format("{} frame {}", spec_, written_frame(spec_) + frame);
}

RankAnswer search_frame(Communicator& ranks, const RankInput& input, std::uint32_t frame,
                        const std::optional<PeriodicBox>& box, Part part, const RankOptions& options,
                        RankWork& work) {
  if (!box) return search(ranks, std::move(part), options, work);
  return naming(input.name_of(frame),
                [&] { return search_in_box(ranks, input.whole(frame), *box, options, work); });
}

}  // namespace catena::ranks
