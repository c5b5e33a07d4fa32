#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <memory>
#include <new>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/error.h"

int main(int argc, char** argv) {
  CLI::App app{
      "catena finds where a tube, approximated by a chain of spheres, touches itself: by every algorithm of "
      "one paper and by better ones, all proved to give the same pairs.",
      "catena"};
  app.require_subcommand(1);
  app.set_version_flag("--version", CATENA_VERSION);

  std::vector<std::unique_ptr<catena::Command>> commands;
  std::function<int()> run;
  for (const auto& info : catena::CommandRegistry::instance().commands()) {
    auto* command = commands.emplace_back(info.make()).get();
    auto* sub = app.add_subcommand(info.name, info.summary);
    command->configure(*sub);
    sub->callback([&run, command] { run = [command] { return command->run(); }; });
  }

  try {
    app.parse(argc, argv);
    return run();
  } catch (const CLI::Success& done) {  // --help, --version
    return app.exit(done);
  } catch (const CLI::ParseError& wrong) {
    fmt::print(stderr, "catena: {}; see catena --help\n", wrong.what());
  } catch (const catena::Error& error) {
    fmt::print(stderr, "catena: {}\n", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "catena: out of memory; take fewer spheres or ask for counts instead of pairs\n");
  }
  return 2;
}
