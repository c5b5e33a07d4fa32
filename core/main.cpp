#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/guarded_main.h"
#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"

namespace {

int run(int argc, char** argv, bool by_ranks) {
  CLI::App app{
      "catena finds where a tube, approximated by a chain of spheres, touches itself: by every algorithm of "
      "one paper and by better ones, all proved to give the same pairs.",
      "catena"};
  app.require_subcommand(1);
  app.set_version_flag("--version", CATENA_VERSION);

  std::vector<std::unique_ptr<catena::Command>> commands;
  std::vector<std::string> names;
  std::function<int()> chosen;
  for (const auto& info : catena::CommandRegistry::instance().commands(by_ranks)) {
    names.push_back(info.name);
    auto* command = commands.emplace_back(info.make()).get();
    auto* sub = app.add_subcommand(info.name, info.summary);
    command->configure(*sub);
    sub->callback([&chosen, command] { chosen = [command] { return command->run(); }; });
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {  // --help, --version
    std::ostringstream text;
    const int code = app.exit(done, text, text);
    fmt::print("{}", text.str());
    return code;
  } catch (const CLI::ParseError& wrong) {
    const auto unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty() && by_ranks)
      throw catena::InputError(fmt::format("ranks do not share the command '{}', only {}; leave out mpirun",
                                           unknown.front(), fmt::join(names, ", ")));
    if (app.get_subcommands().empty() && !unknown.empty())
      throw catena::InputError(fmt::format("no command is named '{}'{}; see catena --help", unknown.front(),
                                           catena::did_you_mean(unknown.front(), names)));
    throw catena::InputError(fmt::format("{}; see catena --help", wrong.what()));
  }
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  catena::Launcher* const launcher = catena::CommandRegistry::instance().launcher();
  const auto body = [&] { return catena::guarded_main("catena", [&] { return run(argc, argv, launcher != nullptr); }); };
  return launcher != nullptr ? launcher->run(body) : body();
}
