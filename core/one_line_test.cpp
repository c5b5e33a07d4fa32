#include "catena/core/one_line.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace catena {
namespace {

TEST(OneLine, KeepsWhatPrints) {
  EXPECT_EQ(one_line(""), "");
  EXPECT_EQ(one_line("a.swc:3: x 'abc' is not a number "), "a.swc:3: x 'abc' is not a number ");
  EXPECT_EQ(one_line("Å/α/鎖/🧬 it is"), "Å/α/鎖/🧬 it is");
}

TEST(OneLine, ShowsControlCharactersAndBrokenBytesAsQuestionMarks) {
  EXPECT_EQ(one_line("a\x1B[31m\nb\x7F"), "a?[31m b?");
  EXPECT_EQ(one_line("a\xC2\x9B"
                     "31m"),
            "a??31m");  // a control character of two bytes
  EXPECT_EQ(one_line("\xFF\xC3 \xE2\x82"), "?? ??");
}

TEST(OneLine, CutsLongText) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "é ";
  EXPECT_LT(one_line(text).size(), 4010u);
  EXPECT_TRUE(one_line(text).starts_with("é é "));
}

TEST(OneLine, ShortensLongWords) {
  const std::string text = one_line("one " + std::string(100'000, 'x') + " two");
  EXPECT_LT(text.size(), 220u);
  EXPECT_TRUE(text.starts_with("one xxx"));
  EXPECT_TRUE(text.ends_with("xxx two"));
  const std::string longest(200, 'x');
  EXPECT_EQ(one_line(longest), longest);
  EXPECT_LT(one_line(longest + 'x').size(), longest.size());
}

TEST(OneLine, CutsNoCharacterInTwo) {
  for (const std::string character : {"é", "鎖", "🧬"})
    for (std::size_t shift = 0; shift < 4; ++shift)
      for (std::size_t end = 0; end < 4; ++end) {
        std::string word(shift, 'x');
        for (int k = 0; k < 300; ++k) word += character;
        const std::string line = one_line(word += std::string(end, 'x'));
        EXPECT_LT(line.size(), word.size());
        EXPECT_EQ(one_line(line), line) << "every byte of it is shown";
      }
}

RC_GTEST_PROP(OneLine, LeavesNoControlByteAndNoLongWord, ()) {
  const auto bytes = *rc::gen::container<std::vector<unsigned char>>(rc::gen::inRange<unsigned char>(0, 255));
  std::string text;
  for (const auto times = *rc::gen::inRange(1, 40);
       text.size() < static_cast<std::size_t>(times) * bytes.size();)
    text.append(bytes.begin(), bytes.end());
  const std::string line = one_line(text);
  std::size_t word = 0;
  for (const char c : line) {
    RC_ASSERT(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    word = c == ' ' ? 0 : word + 1;
    RC_ASSERT(word <= 200u);
  }
  RC_ASSERT(one_line(line) == line);
}

}  // namespace
}  // namespace catena
