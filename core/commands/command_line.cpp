#include "catena/core/commands/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>

#include "catena/core/commands/command.h"
#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/parameters/whole_number.h"

namespace catena {

Option Option::required() const { return Option(option_->required()); }
Option Option::type_name(const std::string& name) const { return Option(option_->type_name(name)); }
Option Option::capture_default_str() const { return Option(option_->capture_default_str()); }
Option Option::allow_extra_args(bool several) const { return Option(option_->allow_extra_args(several)); }
Option Option::expected(int values) const { return Option(option_->expected(values)); }
Option Option::take_all() const { return Option(option_->take_all()); }
Option Option::delimiter(char between) const { return Option(option_->delimiter(between)); }
Option Option::excludes(Option other) const { return option_->excludes(other.option_), *this; }

namespace {

/// What does not hold of the text is said in these words; help shows `shown`.
CLI::Validator refusing(std::function<std::string(std::string&)> words, std::string shown = "") {
  return CLI::Validator(std::move(words), std::move(shown));
}

/// Writes the number out, as CLI11 reads it.
CLI::Validator whole(std::uint64_t least, std::optional<std::uint64_t> most) {
  const std::string bounds = fmt::format("from {} {}", least, most ? fmt::format("to {}", *most) : "on");
  return refusing(
      [=](std::string& text) {
        const auto number = catena::whole_number(text);
        if (!number || *number < least || (most && *number > *most))
          return fmt::format("{} is not a whole number {}", text, bounds);
        text = std::to_string(*number);
        return std::string();
      },
      most || least > 0 ? bounds : "");  // what --help shows
}

/// A finite number of which `holds` is true.
CLI::Validator number(std::function<bool(double)> holds, const std::string& bounds) {
  return refusing(
      [=](std::string& text) {
        double number = 0;
        const bool fits = CLI::detail::lexical_cast(text, number) && std::isfinite(number) && holds(number);
        return fits ? "" : fmt::format("{} is not a number {}", text, bounds);
      },
      bounds);
}

}  // namespace

template <class T>
Option Option::range(T least, T most) const {
  if constexpr (std::is_same_v<T, double>)
    return Option(option_->check(number([=](double x) { return least <= x && x <= most; },
                                        fmt::format("from {:g} to {:g}", least, most))));
  else
    return Option(
        option_->transform(whole(static_cast<std::uint64_t>(least), static_cast<std::uint64_t>(most))));
}
template Option Option::range(int, int) const;
template Option Option::range(unsigned, unsigned) const;
template Option Option::range(std::uint64_t, std::uint64_t) const;
template Option Option::range(double, double) const;

Option Option::positive() const {
  return Option(option_->check(number([](double x) { return x > 0; }, "above 0")));
}

Option Option::one_of(const std::vector<std::string>& names) const {
  return Option(option_->check(refusing(
      [names](const std::string& text) {
        if (std::ranges::find(names, text) != names.end()) return std::string();
        return fmt::format("{} is none of {}{}", text, fmt::join(names, ", "), did_you_mean(text, names));
      },
      fmt::format("{{{}}}", fmt::join(names, ",")))));
}

Option Option::whole_number(std::uint64_t least) const {
  return Option(option_->transform(whole(least, {})));
}

namespace {

/// "nan" reads as a number, which no bound refuses.
std::string refusal_of_no_number(const std::string& text) {
  double number = 0;
  const bool is = CLI::detail::lexical_cast(text, number) && !std::isnan(number);
  return is ? "" : text + " is not a number";
}

/// CLI11 gives an option whatever comes next; a file that is called as an option was hardly meant, and
/// nothing, as of a variable that is not set, is not the same as no option.
std::string refusal_of_no_word(const std::string& text) {
  if (text.empty()) return "'' is no value; give one, or leave the option out";
  return text.starts_with("--") ? fmt::format("{} is an option and no value; ./{} is a file", text, text)
                                : "";
}

/// The option that no command of this name has; empty: it is not that.
std::string unknown_option(const CLI::App& command) {
  const auto left = command.remaining();
  const std::string name = left.empty() ? "" : left.front().substr(0, left.front().find('='));
  return name.size() > 1 && name.starts_with("-") ? name : "";
}

/// A command of one process takes it.
bool known_without_ranks(const std::string& option, const std::string& command) {
  for (const CommandInfo& info : CommandRegistry::instance().commands()) {
    if (info.name != command) continue;
    CLI::App alone;
    OptionParser parser(alone);
    const auto made = info.make();
    made->configure(parser);
    return alone.get_option_no_throw(option) != nullptr;
  }
  return false;
}

/// What is wrong with the arguments of a command.
std::string words_of(const CLI::ParseError& wrong, const CLI::App& command) {
  std::vector<std::string> known;
  for (const CLI::Option* const option : command.get_options()) {
    if (option->count() > 1 && option->get_items_expected_max() == 1)
      return fmt::format("{} is given {} times, and takes one value", option->get_name(), option->count());
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  const auto left = command.remaining();
  const std::string words = wrong.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&wrong) != nullptr) {
    const std::string name = words.substr(0, words.find(':'));
    const CLI::Option* const option = command.get_option_no_throw(name);
    const int takes = option != nullptr ? option->get_items_expected_max() : 1;
    return takes > 1 ? fmt::format("{} takes {} values", name, takes) : name + " lacks a value";
  }
  if (left.empty()) return words;
  if (const std::string name = unknown_option(command); !name.empty())
    return fmt::format("there is no option {} here{}", name, did_you_mean(name, known));
  return fmt::format("{} is one argument too many", left.front());
}

}  // namespace

template <class T>
Option OptionParser::add_option(const std::string& name, T& value, const std::string& meaning) {
  CLI::Option* const option = app_.add_option(name, value, meaning);
  constexpr bool real = std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>> ||
                        std::is_same_v<T, std::vector<double>>;
  if constexpr (real) option->check(refusing(refusal_of_no_number));
  constexpr bool words = std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<std::string>>;
  if (words && name.starts_with("-")) option->check(refusing(refusal_of_no_word));
  return Option(option);
}
template Option OptionParser::add_option(const std::string&, std::string&, const std::string&);
template Option OptionParser::add_option(const std::string&, int&, const std::string&);
template Option OptionParser::add_option(const std::string&, std::uint32_t&, const std::string&);
template Option OptionParser::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option OptionParser::add_option(const std::string&, double&, const std::string&);
template Option OptionParser::add_option(const std::string&, std::optional<std::uint32_t>&,
                                         const std::string&);
template Option OptionParser::add_option(const std::string&, std::optional<std::uint64_t>&,
                                         const std::string&);
template Option OptionParser::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option OptionParser::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option OptionParser::add_option(const std::string&, std::vector<std::uint32_t>&, const std::string&);
template Option OptionParser::add_option(const std::string&, std::vector<double>&, const std::string&);

Option OptionParser::add_option_function(const std::string& name,
                                         const std::function<void(const std::string&)>& take,
                                         const std::string& meaning) {
  return Option(app_.add_option_function<std::string>(name, take, meaning));
}

Option OptionParser::add_flag(const std::string& name, bool& given, const std::string& meaning) {
  return Option(app_.add_flag(name, given, meaning));
}

void OptionParser::exclude_others(Option option, const std::vector<std::string>& but) {
  for (CLI::Option* const other : app_.get_options())
    if (other != option.option_ && other->get_name() != "--help" &&
        std::ranges::count(but, other->get_name()) == 0)
      option.option_->excludes(other);
}

void OptionParser::footer(const std::string& text) { app_.footer(text); }

void refuse_left_out(const std::string& command, const std::string& left_out) {
  std::istringstream names(left_out);
  for (std::string name; names >> name;)
    if (name == command)
      throw InputError(fmt::format(
          "the command '{}' is left out of this build (CATENA_BENCH=OFF); build with CATENA_BENCH=ON",
          command));
}

std::unique_ptr<Command> parse_command_line(int argc, char** argv, bool by_ranks) {
  CLI::App app{
      "catena finds where a tube, approximated by a chain of spheres, touches itself: by every algorithm of "
      "one paper and by better ones, all proved to give the same pairs.",
      "catena"};
  app.require_subcommand(1);
  app.set_version_flag("--version", CATENA_VERSION);

  std::vector<std::unique_ptr<Command>> commands;
  std::vector<std::string> names;
  std::unique_ptr<Command>* chosen = nullptr;
  const auto infos = CommandRegistry::instance().commands(by_ranks);
  commands.reserve(infos.size());
  for (const auto& info : infos) {
    names.push_back(info.name);
    auto& command = commands.emplace_back(info.make());
    CLI::App* const sub = app.add_subcommand(info.name, info.summary);
    OptionParser parser(*sub);
    command->configure(parser);
    sub->callback([&chosen, &command] { chosen = &command; });
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {  // --help, --version
    std::ostringstream text;
    app.exit(done, text, text);
    fmt::print("{}", text.str());
    return nullptr;
  } catch (const CLI::ParseError& wrong) {
    const auto unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty()) refuse_left_out(unknown.front(), CATENA_LEFT_OUT);
    if (app.get_subcommands().empty() && !unknown.empty() && by_ranks)
      throw InputError(fmt::format("ranks do not share the command '{}', only {}; leave out mpirun",
                                   unknown.front(), fmt::join(names, ", ")));
    if (app.get_subcommands().empty() && !unknown.empty())
      throw InputError(fmt::format("no command is named '{}'{}; see catena --help", unknown.front(),
                                   did_you_mean(unknown.front(), names)));
    const auto command = app.get_subcommands();
    if (command.empty()) throw InputError(fmt::format("{}; see catena --help", wrong.what()));
    const std::string name = command.front()->get_name(), option = unknown_option(*command.front());
    if (by_ranks && !option.empty() && known_without_ranks(option, name))
      throw InputError(fmt::format("ranks do not share {} {}; leave out mpirun", name, option));
    throw InputError(fmt::format("{}; see {}catena {} --help", words_of(wrong, *command.front()),
                                 by_ranks ? "mpirun -n 2 " : "", name));
  }
  return std::move(*chosen);
}

namespace {

void parse(CLI::App& app, std::vector<std::string>& arguments,
           const std::function<void(OptionParser&)>& configure) {
  OptionParser parser(app);
  configure(parser);
  std::ranges::reverse(arguments);  // as CLI11 takes them
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& wrong) {
    throw InputError(words_of(wrong, app));
  }
}

}  // namespace

void parse_options(std::vector<std::string> arguments, const std::function<void(OptionParser&)>& configure) {
  CLI::App app;
  parse(app, arguments, configure);
}

std::vector<std::string> parse_known_options(std::vector<std::string> arguments,
                                             const std::function<void(OptionParser&)>& configure) {
  CLI::App app;
  app.allow_extras();
  app.set_help_flag();
  parse(app, arguments, configure);
  return app.remaining();
}

std::string help_of(const std::string& program, const std::function<void(OptionParser&)>& configure) {
  CLI::App app;
  app.set_help_flag();
  OptionParser parser(app);
  configure(parser);
  return app.help(program);
}

}  // namespace catena
