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

template <class T>
Option Option::range(T least, T most) const {
  return Option(option_->check(CLI::Range(least, most)));
}
template Option Option::range(int, int) const;
template Option Option::range(unsigned, unsigned) const;
template Option Option::range(std::uint64_t, std::uint64_t) const;
template Option Option::range(double, double) const;

Option Option::positive() const { return Option(option_->check(CLI::PositiveNumber)); }

Option Option::one_of(const std::vector<std::string>& names) const {
  return Option(option_->check(CLI::IsMember(names)));
}

Option Option::whole_number(std::uint64_t least) const {
  const auto written_out = [least](std::string& text) {
    const auto number = catena::whole_number(text);
    if (!number || *number < least) return fmt::format("{} is not a whole number from {}", text, least);
    text = std::to_string(*number);
    return std::string();
  };
  return Option(option_->transform(CLI::Validator(written_out, "")));
}

namespace {

/// "nan" reads as a number, which no bound refuses.
std::string refusal_of_nan(const std::string& text) {
  double number = 0;
  const bool is = CLI::detail::lexical_cast(text, number) && std::isnan(number);
  return is ? text + " is not a number" : "";
}

}  // namespace

template <class T>
Option OptionParser::add_option(const std::string& name, T& value, const std::string& meaning) {
  CLI::Option* const option = app_.add_option(name, value, meaning);
  constexpr bool real = std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>> ||
                        std::is_same_v<T, std::vector<double>>;
  if constexpr (real) option->check(CLI::Validator(refusal_of_nan, ""));
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
    if (app.get_subcommands().empty() && !unknown.empty() && by_ranks)
      throw InputError(fmt::format("ranks do not share the command '{}', only {}; leave out mpirun",
                                   unknown.front(), fmt::join(names, ", ")));
    if (app.get_subcommands().empty() && !unknown.empty())
      throw InputError(fmt::format("no command is named '{}'{}; see catena --help", unknown.front(),
                                   did_you_mean(unknown.front(), names)));
    throw InputError(fmt::format("{}; see catena --help", wrong.what()));
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
    throw InputError(wrong.what());
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

}  // namespace catena
