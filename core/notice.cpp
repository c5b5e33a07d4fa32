#include "catena/core/notice.h"

#include <fmt/format.h>

#include <cstdio>

#include "catena/core/one_line.h"

namespace catena {

void notice(std::string_view program, std::string_view what) {
  const std::string line = fmt::format("{}: {}\n", program, one_line(what));
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace catena
