#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace catena {

class Command;

/// An option of an OptionParser: CLI11's, by the names that it has there. Each function returns the option.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option required() const;
  Option type_name(const std::string& name) const;  ///< what help shows in place of the type
  Option capture_default_str() const;               ///< help shows the value that the variable has now
  Option allow_extra_args(bool several) const;  ///< false: of a vector, one value each time that it is given
  Option expected(int values) const;
  Option take_all() const;
  Option delimiter(char between) const;
  Option excludes(Option other) const;

  // What does not hold of the text is an error, with the text and what should have been.
  template <class T>
  Option range(T least, T most) const;  ///< of int, unsigned, std::uint64_t and double
  Option positive() const;
  Option one_of(const std::vector<std::string>& names) const;
  /// A whole number from `least`, as 1000000 or 1e6. By itself CLI11 takes -5 for 2^64 - 5, and 010 for 8.
  Option whole_number(std::uint64_t least = 0) const;

 private:
  friend class OptionParser;
  CLI::Option* option_;
};

/// The parser of one command's options: a CLI::App, for files that say what options they take. CLI11 is
/// compiled once, in command_line.cpp; it is headers alone, and each file that includes them takes longer
/// over them than over a whole command.
class OptionParser {
 public:
  explicit OptionParser(CLI::App& app) : app_(app) {}

  /// Fills `value`, which must outlive the parsing: a std::string, std::uint32_t, std::uint64_t, int or
  /// double, or a std::optional or std::vector of one (of what command_line.cpp lists).
  template <class T>
  Option add_option(const std::string& name, T& value, const std::string& meaning);
  /// Calls `take` with the text.
  Option add_option_function(const std::string& name, const std::function<void(const std::string&)>& take,
                             const std::string& meaning);
  Option add_flag(const std::string& name, bool& given, const std::string& meaning);
  /// `option` excludes all others that there are by now, but for these and --help.
  void exclude_others(Option option, const std::vector<std::string>& but);
  void footer(const std::string& text);

 private:
  CLI::App& app_;
};

/// Parses the command line of catena: one of its commands, or one of those that ranks share, with its
/// options. Null:
/// --help or --version was asked for, and is printed. Throws InputError.
std::unique_ptr<Command> parse_command_line(int argc, char** argv, bool by_ranks);

/// Throws InputError, saying so, where `command` is one of these names (parted by blanks), which a build
/// without what measures has not.
void refuse_left_out(const std::string& command, const std::string& left_out);

/// Parses arguments by the options that `configure` adds, for a program or a text without commands. Throws
/// InputError.
void parse_options(std::vector<std::string> arguments, const std::function<void(OptionParser&)>& configure);

/// The same where arguments that are none of these options are another's, which may be --help. Returns them
/// in order.
std::vector<std::string> parse_known_options(std::vector<std::string> arguments,
                                             const std::function<void(OptionParser&)>& configure);

/// What --help says of these options of `program`.
std::string help_of(const std::string& program, const std::function<void(OptionParser&)>& configure);

}  // namespace catena
