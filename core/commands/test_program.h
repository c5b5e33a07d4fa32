#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "catena/core/environment.h"

namespace catena {

/// Other builds refuse to measure, before they look at what.
inline bool measures_in_this_build() { return environment().at("build type") == "Release"; }

struct ProgramOutcome {
  int code;
  std::string output;  ///< standard output, then standard error
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

using Texts = std::vector<std::string>;

inline Texts lines_of(const std::string& text) {
  Texts lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}
inline Texts words_of(const std::string& line) {
  Texts words;
  std::istringstream in(line);
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// The program as a user runs it: its exit codes, its one line for bad input, its files and its JSON. In a
/// folder of its own.
class Program : public testing::Test {
 protected:
  /// The folder of the files that tests of the readers read, too.
  static inline const std::string examples = CATENA_SOURCE_DIR "/core/readers/examples/";

  Program()
      : folder_(std::filesystem::temp_directory_path() / ("catena-program-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  ProgramOutcome run(const std::string& arguments) const {
    return shell("catena " + arguments + " > '" + file("out") + "'");
  }
  /// A line of the shell, in which the program is called catena.
  ProgramOutcome shell(const std::string& line) const {
    const std::string out = file("out"), err = file("err");
    std::ofstream(out).close();
    const std::string command =
        std::string("catena() { '") + CATENA_PROGRAM + "' \"$@\"; }; exec 2> '" + err + "'; " + line;
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out) + text_of(err)};
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return "'" + file(name) + "'";
  }

  void expect_refused(const std::string& arguments, const std::string& because) const {
    const ProgramOutcome r = run(arguments);
    EXPECT_EQ(r.code, 2) << arguments;
    EXPECT_NE(r.output.find(because), std::string::npos) << arguments << ": " << r.output;
    EXPECT_EQ(std::ranges::count(r.output, '\n'), 1) << arguments << ": " << r.output;
    EXPECT_TRUE(r.output.starts_with("catena: ")) << r.output;
  }
  void expect_says(const std::string& arguments, int code, const std::vector<std::string>& parts) const {
    const ProgramOutcome r = run(arguments);
    EXPECT_EQ(r.code, code) << arguments << ": " << r.output;
    for (const std::string& part : parts)
      EXPECT_NE(r.output.find(part), std::string::npos)
          << arguments << " does not say '" << part << "': " << r.output;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace catena
