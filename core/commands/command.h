#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace catena {

/// One subcommand of the program, registered by the folder that owns it; main.cpp knows none of them.
class Command {
 public:
  virtual ~Command() = default;
  /// Adds options to the subcommand's parser; called once.
  virtual void configure(CLI::App& app) = 0;
  /// Exit code: 0 clean, 1 a check failed. Errors are thrown: main prints them as one line and exits with 2.
  virtual int run() = 0;
};

struct CommandInfo {
  std::string name, summary;
  std::function<std::unique_ptr<Command>()> make;
};

class CommandRegistry {
 public:
  static CommandRegistry& instance();
  void add(CommandInfo info) { commands_.push_back(std::move(info)); }
  std::vector<CommandInfo> commands() const;  ///< sorted by name

 private:
  std::vector<CommandInfo> commands_;
};

/// One object of this at namespace scope registers a command class.
template <class C>
struct RegisterCommand {
  RegisterCommand(std::string name, std::string summary) {
    CommandRegistry::instance().add(
        {std::move(name), std::move(summary), [] { return std::make_unique<C>(); }});
  }
};

}  // namespace catena
