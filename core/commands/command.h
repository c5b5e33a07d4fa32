#pragma once
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/commands/launcher.h"
#include "catena/core/commands/command_line.h"

namespace catena {

/// One subcommand of the program, registered by the folder that owns it; main.cpp knows none of them.
class Command {
 public:
  virtual ~Command() = default;
  /// Adds options to the subcommand's parser; called once.
  virtual void configure(OptionParser& app) = 0;
  /// Exit code: 0 clean, 1 a check failed. Errors are thrown: main prints them as one line and exits with 2.
  virtual int run() = 0;
};

/// What the program knows of a subcommand before it is chosen.
struct CommandInfo {
  std::string name, summary;
  std::function<std::unique_ptr<Command>()> make;
  /// For processes that a Launcher brings together, in place of the command of this name.
  bool by_ranks = false;
};

/// All subcommands of the program, self-registered before main, and how several processes do one together.
class CommandRegistry {
 public:
  static CommandRegistry& instance();
  void add(CommandInfo info);
  std::vector<CommandInfo> commands(bool by_ranks = false) const;  ///< sorted by name

  /// Set once, by the folder that owns it.
  void set_launcher(std::unique_ptr<Launcher> launcher) { launcher_ = std::move(launcher); }
  /// The one by which this process was started; null: it is alone.
  Launcher* launcher() const { return launcher_ && launcher_->launched() ? launcher_.get() : nullptr; }

 private:
  std::vector<CommandInfo> commands_;
  std::unique_ptr<Launcher> launcher_;
};

/// One object of this at namespace scope registers a command class.
template <class C>
struct RegisterCommand {
  RegisterCommand(std::string name, std::string summary, bool by_ranks = false) {
    CommandRegistry::instance().add(
        {std::move(name), std::move(summary), [] { return std::make_unique<C>(); }, by_ranks});
  }
};

}  // namespace catena
