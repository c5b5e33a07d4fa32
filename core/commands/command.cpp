#include "catena/core/commands/command.h"

#include <algorithm>

namespace catena {

CommandRegistry& CommandRegistry::instance() {
  static CommandRegistry registry;
  return registry;
}

std::vector<CommandInfo> CommandRegistry::commands(bool by_ranks) const {
  auto sorted = commands_;
  std::erase_if(sorted, [&](const CommandInfo& info) { return info.by_ranks != by_ranks; });
  std::ranges::sort(sorted, {}, &CommandInfo::name);
  return sorted;
}

}  // namespace catena
