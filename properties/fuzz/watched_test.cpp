#include "catena/properties/fuzz/watched.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace catena::properties {
namespace {

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

TEST(Watched, GivesTheCodeOfWhatEndsByItself) {
  for (const int code : {0, 1, 7}) {
    Notebook notebook;
    const Ending ending = tried(notebook, 10, [&] { return code; });
    EXPECT_EQ(ending.code, code);
    EXPECT_EQ(ending.fault, "");
  }
  Notebook notebook;
  EXPECT_EQ(tried(notebook, 10, []() -> int { throw std::runtime_error("said elsewhere"); }).code, 2);
}

TEST(Watched, SaysACrashAndKeepsWhatWasNoted) {
  Notebook notebook;
  const Ending ending = tried(notebook, 10, [&] {
    notebook.begin("the chain");
    notebook.check("CPU9", "pair set");
    std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would say it in its own way
    std::raise(SIGSEGV);
    return 0;
  });
  EXPECT_EQ(ending.fault, "crashed: Segmentation fault");
  EXPECT_EQ(notebook.chain_file(), "the chain");
  EXPECT_EQ(notebook.variant(), "CPU9");
  EXPECT_EQ(notebook.property(), "pair set");
}

/// The last 32 before the one that is worked at, in order, but for those that are too long.
TEST(Watched, WhatWasBegunBeforeIsKept) {
  constexpr std::size_t longest = 64u << 10;
  Notebook notebook;
  std::vector<std::string> begun;
  for (std::size_t k = 0; k < 50; ++k) {
    const std::vector<std::string> all(
        begun.end() - static_cast<std::ptrdiff_t>(std::min<std::size_t>(32, k)), begun.end());
    std::vector<std::string> kept;
    std::ranges::copy_if(all, std::back_inserter(kept),
                         [&](const auto& text) { return text.size() <= longest; });
    begun.push_back(k == 7 || k == 30 ? std::string(longest + (k == 30), 'x') : std::to_string(k));
    notebook.begin(begun.back());
    EXPECT_EQ(notebook.before(), kept) << k;
    EXPECT_EQ(notebook.chain_file(), begun.back());
  }
}

/// A key stroke may come twice, the second time when the work is over and its end is being told.
TEST(Watched, AnInterruptThatComesTwiceIsNoCrash) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Notebook notebook;
    bool mine = false;
    const Ending ending = watched(
        notebook, 10,
        [&] {
          std::raise(signal);
          return interrupted() ? 5 : 6;
        },
        mine);
    if (mine) {
      std::raise(signal);
      std::_Exit(ending.code);
    }
    EXPECT_EQ(ending.fault, "");
    EXPECT_EQ(ending.code, 5);
  }
}

TEST(Watched, AnEndInTheMiddleIsAFault) {
  Notebook notebook;
  const Ending ending = tried(notebook, 10, []() -> int { std::_Exit(0); });
  EXPECT_EQ(ending.fault, "ended the program with exit code 0");
}

TEST(Watched, KillsWhatHangsAndNotWhatGoesOn) {
  Notebook busy;
  const Ending goes_on = tried(busy, 0.5, [&] {
    for (int k = 0; k < 10; ++k) busy.check("CPU9", "pair set"), sleep_ms(100);
    return 3;
  });
  EXPECT_EQ(goes_on.code, 3) << "a second of work in steps";
  EXPECT_EQ(goes_on.fault, "");
  Notebook stuck;
  const Ending hung = tried(stuck, 0.2, [] {
    for (;;) sleep_ms(1000);
    return 0;
  });
  EXPECT_EQ(hung.fault, "hung: no end after 0.2 s");
}

}  // namespace
}  // namespace catena::properties
