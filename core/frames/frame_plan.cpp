#include <fmt/format.h>

#include <cstdlib>

#include "catena/core/counted.h"
#include "catena/core/frames/frame_search.h"

// What is said of how a frame was searched.
namespace catena {

Plan FrameSearch::plan() const {
  if (!updated_) return {};
  const std::string saved = fmt::format("{:.3g} ms of a full search", policy_.full_ms());
  const auto left_out = [&](Omission omission, std::string reason, std::string removed) {
    return Decision{info_of(omission).step, true,     std::move(reason),
                    policy_.full_ms(),      find_ms_, std::move(removed)};
  };
  const std::size_t n = row_.spheres().size();
  switch (way_) {
    case Way::full:
      break;
    case Way::unmoved:
      return {left_out(Omission::unmoved, fmt::format("none of {} differs", counted(n, "sphere")), saved)};
    case Way::parts:
      return {left_out(Omission::still_parts, fmt::format("{} of {} moved", moved_, counted(n, "sphere")),
                       fmt::format("all but {} of {}", counted(compared_, "run"), RunTree::run))};
    case Way::shifted:
      return {left_out(
          Omission::shifted,
          fmt::format("sphere i is what i {} {} was, of {}", shift_ < 0 ? '-' : '+', std::abs(shift_), n),
          fmt::format("all but {} of {}", counted(compared_, "run"), RunTree::run))};
    case Way::kept_list:
      return {
          left_out(Omission::far_pairs,
                   fmt::format("each of {} is within a skin of {:.3g}", counted(n, "sphere"), list_->skin()),
                   fmt::format("all but {} whose state may change", counted(compared_, "pair")))};
  }
  return {{"search of the whole frame", false, why_full(), std::nullopt, full_ms_}};
}

std::string FrameSearch::why_full() const {
  switch (why_) {
    case Why::not_kept:
      return "the pairs of the frame before are not kept: to keep them took more than it saved, or they were "
             "not all asked for";
    case Why::crowded:
      return "more pairs collide than are kept from frame to frame, or so many came of what moved";
    case Why::another:
      return "not the chain of the frame before, or not its rule";
    case Why::doubt:
      return "once in a while, to know what it takes";
    case Why::no_list:
      return "a kept list would have too many pairs, or spheres without end";
    case Why::unlike:
      break;
  }
  std::string reason = "too little in common with the frame before";
  for (const Omission omission :
       {Omission::unmoved, Omission::still_parts, Omission::shifted, Omission::far_pairs})
    if (!omissions_.may(omission)) reason += "; --no-omit " + info_of(omission).name;
  if (!can_shift_ && omissions_.may(Omission::shifted))
    reason += "; a shift is looked for in one open strand under an index window";
  if (!can_keep_ && omissions_.may(Omission::far_pairs)) reason += "; under an arc window no list is kept";
  return reason;
}

}  // namespace catena
