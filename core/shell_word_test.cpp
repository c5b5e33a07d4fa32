#include "catena/core/shell_word.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace catena {
namespace {

/// What a shell takes the words of a command for, each with a line end behind it.
std::string words_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> shell(
      popen(("printf '%s\\n' " + command).c_str(), "r"), pclose);
  std::string words;
  std::array<char, 256> part;
  while (std::fgets(part.data(), part.size(), shell.get()) != nullptr) words += part.data();
  return words;
}

TEST(ShellWord, IsOneWordOfAShellWhateverItHolds) {
  std::string command, words;
  for (const std::string text : {"path1:n=100,frame=3", "DeviceGrid(binned=0)", "a b", "it's", "''", "$HOME", "`ls`",
                                 "a\\b", "*", "~", "#x", "a;b", "\"q\"", "x|y", ""}) {
    command += " " + shell_word(text);
    words += text + "\n";
  }
  EXPECT_EQ(words_of(command), words);
}

TEST(ShellWord, StaysAsItIsWhereNothingOfItMeansAnything) {
  for (const char* text : {"path1:n=1e6", "../a_b-1.csv", "aCPU2+CPU2", "50%", "x@y"})
    EXPECT_EQ(shell_word(text), text);
  EXPECT_EQ(shell_word("a b"), "'a b'");
}

}  // namespace
}  // namespace catena
