#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catena/core/commands/test_program.h"

/// README and the pages beside what they describe against the program.
namespace catena {
namespace {

/// A command as README shows it, and what it says that this prints; empty: it does not say.
struct Shown {
  std::string command, printed;
};

std::vector<Shown> shown_in(const std::string& text) {
  std::vector<Shown> all;
  std::istringstream lines(text);
  bool console = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      console = line == "```console";
    else if (console && line.starts_with("$ "))
      all.push_back({line.substr(2), ""});
    else if (console && !all.empty())
      all.back().printed += line + '\n';
  }
  return all;
}

/// Without what differs from run to run: times.
std::string steady(const std::string& text) {
  static const std::regex milliseconds("[0-9.]+ ms"),
      threads("\\(threads=[0-9]+\\)");  // as many as the machine has
  return std::regex_replace(std::regex_replace(text, milliseconds, "# ms"), threads, "");
}

class Readme : public Program {
 protected:
  const std::filesystem::path source_ = CATENA_SOURCE_DIR;

  /// README and all other pages, by their paths in the source tree; not what was built or measured in it.
  std::vector<std::string> pages() const {
    std::vector<std::string> found{"README.md"};
    for (const char* folder : {"bench", "core", "cuda", "properties", "reference", "reports", "variants"})
      for (const auto& file : std::filesystem::recursive_directory_iterator(source_ / folder))
        if (file.path().extension() == ".md")
          found.push_back(std::filesystem::relative(file.path(), source_).string());
    return found;
  }

  Readme() { setenv("XDG_CACHE_HOME", file("cache").c_str(), 1); }
  ~Readme() override { unsetenv("XDG_CACHE_HOME"); }
};

TEST_F(Readme, ShowsWhatTheProgramPrints) {
  std::filesystem::create_symlink(CATENA_SOURCE_DIR "/core", file("core"));
  std::size_t compared = 0;
  for (const Shown& shown : shown_in(text_of(source_ / "README.md"))) {
    if (shown.command.find("Sweep") != std::string::npos) continue;  // a variant of the reader's own
    const ProgramOutcome r = shell("cd '" + file("") + "' && " + shown.command + " > '" + file("out") + "'");
    EXPECT_LT(r.code, 2) << shown.command << ": " << r.output;
    if (shown.printed.empty()) continue;
    EXPECT_EQ(steady(r.output), steady(shown.printed)) << shown.command;
    ++compared;
  }
  EXPECT_GE(compared, 2u);
}

/// What is in backticks in the page, as far as it looks like a path of ours, with the folders that it leads
/// through.
std::set<std::string> paths_in(const std::string& page) {
  static const std::regex path(
      "`((?:bench|core|cuda|properties|reference|reports|variants)/[A-Za-z0-9_./]*)`");
  std::set<std::string> paths;
  for (std::sregex_iterator at(page.begin(), page.end(), path), end; at != end; ++at) paths.insert((*at)[1]);
  return paths;
}

TEST_F(Readme, LeadsToEveryPageAndEachNamesFilesThatAreThere) {
  std::set<std::string> reached{"README.md"}, left = reached;
  while (!left.empty()) {
    const std::string page = left.extract(left.begin()).value();
    for (const std::string& path : paths_in(text_of(source_ / page))) {
      EXPECT_TRUE(std::filesystem::exists(source_ / path)) << page << " names " << path;
      if (path.ends_with(".md") && reached.insert(path).second) left.insert(path);
    }
  }
  const std::vector<std::string> all = pages();
  EXPECT_EQ(reached, std::set<std::string>(all.begin(), all.end()));
}

TEST_F(Readme, TellsOfEveryCommandAndEveryFormat) {
  const std::string readme = text_of(source_ / "README.md"),
                    formats = text_of(source_ / "core/readers/formats.md"), help = run("--help").output;
  static const std::regex command("\n  ([a-z][a-z-]+)  +[A-Z]");
  std::size_t commands = 0;
  for (std::sregex_iterator at(help.begin(), help.end(), command), end; at != end; ++at, ++commands)
    EXPECT_NE(readme.find("| `catena " + (*at)[1].str()), std::string::npos) << (*at)[1];
  EXPECT_GE(commands, 20u);
  const auto readers = nlohmann::json::parse(run("list --json").output).at("readers");
  EXPECT_FALSE(readers.empty());
  for (const auto& reader : readers) {
    const std::vector<std::string> extensions = reader.at("extensions");
    const auto is_in = [](const std::string& page) {
      return [&page](const std::string& extension) {
        return page.find('`' + extension + '`') != std::string::npos;
      };
    };
    EXPECT_TRUE(std::ranges::any_of(extensions, is_in(readme))) << extensions.front();
    EXPECT_TRUE(std::ranges::all_of(extensions, is_in(formats))) << extensions.front();
  }
}

void collect_keys(const nlohmann::json& json, std::set<std::string>& keys) {
  if (json.is_object())
    for (const auto& [key, value] : json.items()) {
      keys.insert(key);
      if (key != "settings" && key != "environment")
        collect_keys(value, keys);  // keys of a strategy's own, and facts
    }
  if (json.is_array())
    for (const auto& value : json) collect_keys(value, keys);
}

/// What json.md says of a command: from its name to the next.
std::string documented(const std::string& command) {
  const std::string text = text_of(CATENA_SOURCE_DIR "/core/commands/json.md");
  const auto begin = text.find('\n' + command + ' ');
  if (begin == std::string::npos) return "";
  static const std::regex next("\n([a-z`])");
  std::smatch found;
  const std::string rest = text.substr(begin + 1);
  return std::regex_search(rest, found, next) ? rest.substr(0, static_cast<std::size_t>(found.position()))
                                              : rest;
}

/// The commands whose help says --json.
std::set<std::string> commands_with_json(const std::function<std::string(const std::string&)>& printed) {
  static const std::regex command("\n  ([a-z][a-z-]+)  +[A-Z]");
  const std::string help = printed("--help");
  std::set<std::string> found;
  for (std::sregex_iterator at(help.begin(), help.end(), command), end; at != end; ++at)
    if (const std::string name = (*at)[1]; printed(name + " --help").find("--json") != std::string::npos)
      found.insert(name);
  return found;
}

TEST_F(Readme, EveryKeyOfEveryLineOfJsonIsDocumented) {
  std::set<std::string> left = commands_with_json([&](const std::string& line) { return run(line).output; });
  EXPECT_GE(left.size(), 16u);
  for (const std::string run_line :
       {"motion --frames 2 --starts 1 --repetitions 1 --n 60 --duration 1 --stiffness 100 --step 1 --offset "
        "0",
        "work-precision straight_rod --n 40 --n 3000 --tolerance 0.1 --variant CPU1 --variant Grid "
        "--repetitions 3",
        "errors straight_rod --n 8",
        "enumerate --walks 2 --radius 0.8",
        "detect coincident:n=9 --plan",
        "detect coincident:n=9 --any",
        "detect path1:n=2000,spacing=0.2 --tolerance 0.1 --arc-window 2",
        "plan coincident:n=9 --run",
        "calibrate",
        "list",
        "margins coincident:n=9 lattice:n=30",
        "verify lattice:n=60 --variant CPU1 --variant aCPU2+CPU2/literal --variant aCPU2+Dual --certify",
        "verify lattice:n=2000 --variant bGPU2@host+CPU2",
        "examine rod:n=50",
        "stability --n 60 --variant CPU1/literal --variant aCPU2+CPU2",
        "errors --n 60",
        "enumerate --walks 3",
        "closed-form --side 4",
        "growth path1 --n 32000 --variant Necklace",
        "regret path1:n=16 --variant CPU1 --seconds 0.01",
        "knots --n 16",
        "pivot --n 512 --moves 1000 --exponent",
        "pivot --n 90 --moves 64 --at-once",
        "scaling yarn:n=3000 --ranks 16"}) {
    const std::string command = run_line.substr(0, run_line.find(' ')), said = documented(command);
    left.erase(command);
    if (!measures_in_this_build() && (command == "motion" || command == "work-precision")) continue;
    const ProgramOutcome r = run(run_line + " --json");
    ASSERT_LT(r.code, 2) << run_line << ": " << r.output;
    std::set<std::string> keys;
    std::istringstream lines(r.output);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("{")) collect_keys(nlohmann::json::parse(line), keys);
    EXPECT_FALSE(keys.empty()) << run_line << ": " << r.output;
    for (const std::string& key : keys)
      EXPECT_TRUE(std::regex_search(said, std::regex("\\b" + key + "\\b")))
          << command << " prints '" << key << "'";
  }
  EXPECT_TRUE(left.empty()) << *left.begin() << " has --json and is not run here";
}

}  // namespace
}  // namespace catena
