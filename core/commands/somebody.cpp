#include "catena/core/commands/somebody.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/error.h"

namespace catena {

void require_somebody(std::span<const VariantInfo> asked) {
  const auto absent = [](const VariantInfo& v) { return v.unavailable.has_value(); };
  if (!asked.empty() && std::ranges::all_of(asked, absent))
    throw InputError(fmt::format("{} is not available here: {}; see catena list", asked.front().name,
                                 *asked.front().unavailable));
}

}  // namespace catena
