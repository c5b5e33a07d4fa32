#include "catena/core/commands/show_warnings.h"

#include <fmt/format.h>

#include "catena/core/notice.h"

namespace catena {

void show_warnings(const Input& input) {
  for (const auto& warning : input.warnings) notice("catena", fmt::format("{}: {}", input.name, warning));
}

}  // namespace catena
