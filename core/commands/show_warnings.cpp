#include "catena/core/commands/show_warnings.h"

#include <fmt/format.h>

#include <cstdio>

#include "catena/core/one_line.h"

namespace catena {

void show_warnings(const Input& input) {
  for (const auto& warning : input.warnings)
    fmt::print(stderr, "catena: {}\n", one_line(fmt::format("{}: {}", input.name, warning)));
}

}  // namespace catena
