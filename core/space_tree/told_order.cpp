#include "catena/core/space_tree/told_order.h"

#include <fmt/format.h>

namespace catena {

Decision told_order(std::uint32_t entries, std::uint32_t frames) {
  return {"sort in space", frames > 0,
          frames > 0 ? fmt::format("{} lie in much the order of {} frames ago", entries, frames)
                     : fmt::format("{} are put into an order of their own", entries)};
}

}  // namespace catena
