#include "catena/core/readers/text_lines.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

// Lines that may be blank, each with an end of its own; the last one without.
RC_GTEST_PROP(TextLines, EndWithLfCrlfOrCr, (bool once, bool mark)) {
  std::vector<std::string> lines;
  std::string text = mark ? "\xEF\xBB\xBF" : "";
  for (auto left = *rc::gen::inRange(1, 9); left > 0; --left) {
    lines.push_back(*rc::gen::container<std::string>(rc::gen::elementOf(std::string("a ,#\t"))));
    // A CR before an empty line that LF ends would be a CRLF.
    const bool after_cr = text.ends_with('\r') && lines.back().empty();
    text += lines.back();
    text += *rc::gen::elementOf(after_cr ? std::vector<std::string>{"\r\n", "\r"}
                                         : std::vector<std::string>{"\n", "\r\n", "\r"});
  }
  lines.push_back("end");
  const TestFile file("a.txt", text + "end");
  TextLines read(file.path());
  if (once) read.read_once();
  const auto start = read.mark();
  for (int time = 0; time < (once ? 1 : 2); ++time) {
    for (std::size_t k = 0; k < lines.size(); ++k) {
      RC_ASSERT(read.next());
      RC_ASSERT(read.line() == lines[k]);
      RC_ASSERT(read.line_number() == k + 1);
    }
    RC_ASSERT(!read.next());
    read.return_to(start);
  }
}

// What a part of a disk leaves that was lost; as unknown lines PDB and OBJ would skip it, and read half a
// file.
TEST(TextLines, RefuseBytesOfZero) {
  for (const std::string name : {"a.pdb", "a.obj", "a.swc", "a.cif", "a.csv", "a.data"})
    EXPECT_COMPLAINT(" byte 9 is 0, so this is no text", name, std::string("v 0 0 0\nv\0\0 1 0\n", 16));
}

TEST(TextLines, CountUpToTwoToThe32) {
  const TestFile file("a.txt", "0 4294967295 4294967296 -1\n");
  TextLines read(file.path());
  ASSERT_TRUE(read.next());
  EXPECT_EQ(read.count(read.fields()[0], "n"), 0u);
  EXPECT_EQ(read.count(read.fields()[1], "n"), 4294967295u);
  EXPECT_THROW(read.count(read.fields()[2], "n"), InputError);
  EXPECT_THROW(read.count(read.fields()[3], "n"), InputError);
}

TEST(TextLines, GiveTheMemoryOfWhatWasReadBackAndNothingElse) {
  constexpr std::uint32_t lines = 1500000;
  std::string text;
  for (std::uint32_t k = 0; k < lines; ++k) text += std::to_string(k) + (k % 3 ? "\n" : "\r");
  ASSERT_GT(text.size(), std::size_t{8} << 20);  // two pieces
  const TestFile file("a.txt", text);
  TextLines read(file.path());
  read.read_once();
  for (std::uint32_t k = 0; k < lines; ++k) {
    ASSERT_TRUE(read.next());
    ASSERT_EQ(read.line(), std::to_string(k));
  }
  EXPECT_FALSE(read.next());
}

}  // namespace
}  // namespace catena
