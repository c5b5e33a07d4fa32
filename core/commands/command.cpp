#include "catena/core/commands/command.h"

#include <algorithm>
#include <stdexcept>

namespace catena {

CommandRegistry& CommandRegistry::instance() {
  static CommandRegistry registry;
  return registry;
}

void CommandRegistry::add(CommandInfo info) {
  for (const CommandInfo& other : commands_)
    if (other.name == info.name && other.by_ranks == info.by_ranks)
      throw std::logic_error("the command " + info.name + " is registered twice");
  commands_.push_back(std::move(info));
}

std::vector<CommandInfo> CommandRegistry::commands(bool by_ranks) const {
  auto sorted = commands_;
  std::erase_if(sorted, [&](const CommandInfo& info) { return info.by_ranks != by_ranks; });
  std::ranges::sort(sorted, {}, &CommandInfo::name);
  return sorted;
}

}  // namespace catena
