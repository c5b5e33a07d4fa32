#include "catena/core/commands/command.h"

#include <algorithm>

namespace catena {

CommandRegistry& CommandRegistry::instance() {
  static CommandRegistry registry;
  return registry;
}

std::vector<CommandInfo> CommandRegistry::commands() const {
  auto sorted = commands_;
  std::ranges::sort(sorted, {}, &CommandInfo::name);
  return sorted;
}

}  // namespace catena
