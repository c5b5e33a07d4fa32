#include "catena/core/commands/alone.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/command_line.h"
#include "catena/core/commands/guarded_main.h"

int main(int argc, char** argv) {
  catena::Launcher* const launcher = catena::CommandRegistry::instance().launcher();
  const auto run = [&] {
    if (launcher == nullptr) catena::require_alone();
    const auto command = catena::parse_command_line(argc, argv, launcher != nullptr);
    return command ? command->run() : 0;
  };
  return launcher != nullptr ? launcher->run(run) : catena::guarded_main("catena", run);
}
