#include "catena/core/space_tree/told_order.h"

#include <fmt/format.h>

namespace catena {

Decision told_order(std::uint32_t entries, std::uint32_t frames) {
  if (entries == 0) return {"sort in space", true, "nothing is put in an order of space"};
  return {"sort in space", frames > 0,
          frames > 0
              ? fmt::format("what {} frames ago was near in an order of {} is so still", frames, entries)
              : fmt::format("{} in an order of their own", entries)};
}

}  // namespace catena
