#include "catena/ranks/rank_input.h"

#include <fmt/format.h>

#include "catena/core/commands/show_warnings.h"
#include "catena/ranks/bytes.h"

namespace catena::ranks {

RankInput::RankInput(Communicator& ranks, const std::string& spec, const InputOptions& options) : ranks_(ranks) {
  if (ranks.rank() != 0) return;
  input_ = open_input(spec, options);
  show_warnings(*input_);
  if (!input_->boxes.empty())
    throw InputError(fmt::format("{}: ranks do not repeat space; say --box none, or leave out mpirun", spec));
}

std::pair<std::uint32_t, std::uint32_t> RankInput::frames(const FrameOption& option) const {
  struct Frames {
    std::uint32_t first, last;
  } frames{0, 0};
  if (input_) std::tie(frames.first, frames.last) = option.of(*input_);
  const Frames told = all_gather_value(ranks_, frames).front();
  return {told.first, told.last};
}

NamedPart RankInput::part(std::uint32_t frame) const {
  Chain chain;
  if (input_) chain = input_->animation->frame(frame);
  return scatter(ranks_, [&](unsigned rank) {
    const auto start = [&](unsigned r) { return static_cast<std::uint32_t>(even_start(chain.size(), ranks_.size(), r)); };
    return named_part_of(chain, input_->labels, start(rank), start(rank + 1));
  });
}

}  // namespace catena::ranks
