#include <fmt/format.h>

#include <cstdlib>

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
      return {left_out(Omission::unmoved, fmt::format("none of {} spheres differs", n), saved)};
    case Way::parts:
      return {left_out(Omission::still_parts, fmt::format("{} of {} spheres moved", moved_, n),
                       fmt::format("all but {} runs of {}", compared_, RunTree::run))};
    case Way::shifted:
      return {left_out(
          Omission::shifted,
          fmt::format("sphere i is what i {} {} was, of {}", shift_ < 0 ? '-' : '+', std::abs(shift_), n),
          fmt::format("all but {} runs of {}", compared_, RunTree::run))};
    case Way::kept_list:
      return {left_out(Omission::far_pairs,
                       fmt::format("each of {} spheres is within a skin of {:.3g}", n, list_->skin()),
                       fmt::format("all but {} pairs whose state may change", compared_))};
  }
  return {{"search of the whole frame", false, "too little in common with the frame before", std::nullopt,
           full_ms_}};
}

}  // namespace catena
