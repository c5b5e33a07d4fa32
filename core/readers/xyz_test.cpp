#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "catena/core/readers/number_text.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_floats.h"

namespace catena {
namespace {

using Offsets = std::vector<std::uint32_t>;
using Columns = std::vector<std::string>;

float first_x(std::string_view text) { return read_text("a.xyz", text).spheres.at(0).x; }

CurveFile read_as(const Columns& columns, std::string_view content, const std::string& name = "a.txt") {
  const TestFile file(name, content);
  return ReaderRegistry::instance().read(file.path(), {.columns = columns});
}

TEST(XyzReader, ReadsTheDialects) {
  const char* dialects[] = {"7 0 0\n8 0.5 0\n",             // bare
                            "x y z\n7 0 0\n8 0 0\n",        // a header
                            "2\n\n7 0 0\n8 0 0\n",          // count and blank title
                            "2\ntitle 1\n7 0 0\n8 0 0\n",   // count and title
                            "2\n1 2 3\n7 0 0\n8 0 0\n",     // count and a title of numbers
                            "2\n7 0 0\n8 0 0\n",            // count without title
                            "2\nt\nBead 7 0 0\nA 8 0 0\n",  // any word under a count
                            "C 7 0 0\nFe 8 0 0\n",          // elements
                            "7,0,0\n8,0,0\n",
                            "7 0 0 # c\r\n8 0 0\r\n"};
  for (const char* text : dialects) {
    EXPECT_EQ(first_x(text), 7.0f) << text;
    EXPECT_EQ(read_text("a.txt", text).strand_first, (Offsets{0, 2})) << text;
    EXPECT_FALSE(read_text("a.txt", text).has_radii);
  }
}

TEST(XyzReader, DropsNoMalformedPointAsATitle) {
  EXPECT_COMPLAINT("1: z 'O' is not a number", "a.xyz", "0 0 O\n1 0 0\n2 0 0\n3 0 0\n");
  EXPECT_COMPLAINT("1: a point needs three coordinates, got 2 columns", "a.txt", "0 0\n1 0 0\n2 0 0\n");
  EXPECT_COMPLAINT("1: x 'O' is not a number", "a.txt", "O 0 0\n1 0 0\n");
  EXPECT_COMPLAINT("1: a point needs three coordinates, got 'title' alone", "a.txt", "title\n0 0 0\n");
  EXPECT_COMPLAINT("3: z 'O' is not a number", "a.xyz", "2\ntitle\n0 0 O\n1 0 0\n");
  EXPECT_COMPLAINT("1: 3 points are announced, 2 follow", "a.xyz", "3\ntitle\n0 0 0\n1 0 0\n");
  const CurveFile untitled = read_text("a.xyz", "2\n7 0 0\n8 0 0\n");
  const std::vector<std::string> said{"there is no title line after the number of points"};
  EXPECT_EQ(untitled.warnings, said);
  EXPECT_EQ(read_text("a.xyz", "2\n7 0 0\n8 0 0\n2\n7 0 0\n8 0 0\n2\n7 0 0\n8 0 0\n").warnings, said);
}

TEST(XyzReader, RefusesRowsThatCanBeReadInSeveralWays) {
  EXPECT_COMPLAINT(
      "1: 4 numbers in a row can be read in several ways; say which: --columns x,y,z,_, --columns "
      "x,y,z,r, --columns id,x,y,z",
      "a.xyz", "10 0 0 1\n20 0 0 1\n30 0 0 1\n");
  EXPECT_COMPLAINT(
      "3: 4 numbers in a row can be read in several ways; say which: --columns x,y,z,_, --columns "
      "x,y,z,r, --columns element,x,y,z",
      "a.xyz", "2\ntitle\n6 7 0 0\n6 8 0 0\n");
  EXPECT_COMPLAINT("1: a word and 4 numbers", "a.txt", "C 1 0 0 0.5\nC 2 0 0 0.5\n");
  EXPECT_COMPLAINT("3: a word and 4 numbers", "a.xyz", "2\ntitle\nC 1 0 0 0.5\nC 2 0 0 0.5\n");
  EXPECT_COMPLAINT(
      "1: a word and 4 numbers can be read in several ways; say which: --columns element,x,y,z,_, "
      "--columns element,x,y,z,r, --columns chr,_,x,y,z",
      "a.txt", "chr1 100000 0 0 0\nchr1 200000 1 0 0\n");
  EXPECT_COMPLAINT(
      "1: a word and 3 numbers can be read in several ways; say which: --columns element,x,y,z, "
      "--columns strand,x,y,z",
      "a.txt", "A 0 0 0\nA 1 0 0\nB 2 0 0\n");
  EXPECT_COMPLAINT("1: '0.5x' in column 4 is not a number", "a.txt", "0 0 0 0.5x\n");
  EXPECT_COMPLAINT("2: the row has 4 columns, not 3", "a.txt", "0 0 0\n1 0 0 1\n");
}

TEST(XyzReader, TakesTheColumnsThatTheUserNames) {
  const CurveFile radii = read_as({"x", "y", "z", "r"}, "10 0 0 1\n20 0 0 2\n");
  EXPECT_TRUE(radii.has_radii);
  EXPECT_EQ(radii.spheres, (std::vector<Sphere>{{10, 0, 0, 1}, {20, 0, 0, 2}}));
  // A header has nothing to say where the user names the columns.
  EXPECT_EQ(read_as({"z", "y", "x"}, "x y z\n1 2 3\n").spheres, (std::vector<Sphere>{{3, 2, 1, 0}}));
  const CurveFile ids = read_as({"id", "x", "y", "z"}, "10 1 0 1\n20 2 0 1\nEND\n7 3 0 1\n");
  EXPECT_EQ(ids.spheres[1], (Sphere{2, 0, 1, 0}));
  EXPECT_EQ(ids.strand_first, (Offsets{0, 2, 3}));
  EXPECT_EQ(ids.labels.of(2), "7");
  const CurveFile genome =
      read_as({"chr", "_", "x", "y", "z"}, "chr1 100 1 0 0\nchr1 200 2 0 0\nchrX 100 3 0 0\n");
  EXPECT_EQ(genome.spheres[2].x, 3.0f);
  EXPECT_EQ(genome.strand_first, (Offsets{0, 2, 3}));
  EXPECT_EQ(genome.labels.strand_names, (Columns{"chr1", "chrX"}));
  EXPECT_EQ(genome.labels.of(2), "3");
  EXPECT_EQ(read_as({"d", "z", "y", "x"}, "2\nt\n4 3 2 1\n4 3 2 2\n", "a.xyz").spheres[0],
            (Sphere{1, 2, 3, 2}));
}

TEST(XyzReader, RefusesColumnsThatDoNotFit) {
  const auto refusal = [](const Columns& columns, std::string_view text, const std::string& name = "a.txt") {
    try {
      read_as(columns, text, name);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(refusal({"x", "y", "z"}, "1 2 3 4\n").find(":1: the row has 4 columns, not 3"),
            std::string::npos);
  EXPECT_NE(refusal({"strand", "x", "y", "z"}, "a 1 2 3\nEND\na 4 5 6\n")
                .find(":2: a strand ends where its name changes; leave the END out"),
            std::string::npos);
  EXPECT_NE(refusal({"x", "y", "z", "q"}, "1 2 3 4\n").find("'q' is no column"), std::string::npos);
  EXPECT_NE(refusal({"x", "y", "_"}, "1 2 3\n").find("must name x, y and z"), std::string::npos);
  EXPECT_NE(refusal({"x", "y", "z", "x"}, "1 2 3 4\n").find("columns 1 and 4 mean the same"),
            std::string::npos);
  EXPECT_NE(refusal({"x", "y", "z"}, "1 1 0 0 0 1 -1\n", "a.swc")
                .find("--columns means nothing for a SWC neuron file"),
            std::string::npos);
}

// Every number of a file in one row: one short line, and soon.
TEST(XyzReader, RefusesARowOfAMillionNumbers) {
  std::string row;
  for (int k = 0; k < 1'000'000; ++k) row += "0 ";
  EXPECT_EQ(complaint("a.xyz", row + "\n"),
            "a.xyz:1: 1000000 columns in a row; write a row for each point, as x y z");
  EXPECT_EQ(complaint("a.xyz", "1\nt\nC " + row + "\n"),
            "a.xyz:3: 1000001 columns in a row; write a row for each point, as x y z");
}

TEST(XyzReader, SaysThatBlankLinesEndNoStrand) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(read_text("a.xyz", "\n \n0 0 0\n1 0 0\n\n").warnings, Texts{});
  EXPECT_EQ(read_text("a.xyz", "0 0 0\n\n1 0 0\n").warnings,
            Texts{"blank lines do not end a strand; END does"});
}

// Where an option is not heeded, nothing is read as if it had been.
TEST(Readers, RefuseOptionsThatMeanNothingToThem) {
  const TestFile file("a.swc", "1 1 0 0 0 1 -1\n");
  for (const auto& [option, options] :
       std::vector<std::pair<std::string, ReadOptions>>{{"--columns", {.columns = {"x", "y", "z"}}},
                                                        {"--atom", {.atom = "CA"}},
                                                        {"--array", {.array = "r"}},
                                                        {"--topology", {.topology = "a.top"}}}) {
    try {
      ReaderRegistry::instance().read(file.path(), options);
      ADD_FAILURE() << option;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(option + " means nothing for a SWC neuron file"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(XyzReader, RefusesFramesInAnotherOrder) {
  const std::string ids = "2\nProperties=id:I:1:strand:I:1:pos:R:3\n", elements = "2\nt\n";
  EXPECT_COMPLAINT("7: '2' stands where frame 0 has '1'", "a.xyz",
                   ids + "1 0 0 0 0\n2 0 1 0 0\n" + ids + "2 0 1 0 0\n1 0 0 0 0\n");
  EXPECT_COMPLAINT("8: strand '1' stands where frame 0 has '0'", "a.xyz",
                   ids + "1 0 0 0 0\n2 0 1 0 0\n" + ids + "1 0 0 0 0\n2 1 1 0 0\n");
  EXPECT_COMPLAINT("7: 'O1' stands where frame 0 has 'C1'", "a.xyz",
                   elements + "C 0 0 0\nO 1 0 0\n" + elements + "O 1 0 0\nC 0 0 0\n");
  const std::string closed = "2\nProperties=pos:R:3:strand:I:1:closed:I:1\n", last = "1 0 0 1 0\n";
  const std::string first = closed + "0 0 0 0 1\n" + last;
  EXPECT_EQ(read_text("a.xyz", first + first + first).strand_closed, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_COMPLAINT("7: closed '0' stands where frame 0 has 1; a strand is closed in all frames or none",
                   "a.xyz", first + closed + "0 0 0 0 0\n" + last);
  EXPECT_COMPLAINT("8: closed '1' stands where frame 0 has 0", "a.xyz",
                   first + closed + "0 0 0 0 1\n1 0 0 1 1\n");
  EXPECT_EQ(read_text("a.xyz", ids + "1 0 0 0 0\n2 1 1 0 0\n" + ids + "1 0 5 0 0\n2 1 6 0 0\n")
                .later_frames[0][1]
                .x,
            6.0f);
}

TEST(XyzReader, ReadsFramesAsAnAnimation) {
  const CurveFile curves =
      read_text("a.xyz", "2\nt\nC 0 0 0\nO 1 0 0\n\n2\nt\nC 0 0 1\nO 1 0 1\n2\n\nC 0 0 2\nO 1 0 2\n");
  ASSERT_EQ(curves.later_frames.size(), 2u);
  EXPECT_EQ(curves.spheres[1], (Sphere{1, 0, 0, 0}));
  EXPECT_EQ(curves.later_frames[1][1], (Sphere{1, 0, 2, 0}));
  EXPECT_EQ(curves.labels.of(1), "O2");
  EXPECT_EQ(curves.labels.size(), 2u);
  EXPECT_COMPLAINT("5: frame 1 has 1 point, frame 0 has 2", "a.xyz", "2\nt\n0 0 0\n1 0 0\n1\nt\n0 0 0\n");
  EXPECT_COMPLAINT("4: frame 1 has 2 points, frame 0 has 1", "a.xyz", "1\nt\n0 0 0\n2\nt\n0 0 0\n1 0 0\n");
  EXPECT_COMPLAINT("4: the number of points of another frame is due", "a.xyz", "1\nt\n0 0 0\n1 0 0\n");
  EXPECT_COMPLAINT("4: 1 point is announced, 0 follow", "a.xyz", "1\nt\n0 0 0\n1\nt\n");
}

TEST(XyzReader, EndEndsAStrand) {
  const auto curves = read_text("a.xyz", "7 0 0\n8 0 0\nEND\n9 0 0\n9 1 0\nEndMdl\n5 0 0\nend\n");
  EXPECT_EQ(curves.strand_first, (Offsets{0, 2, 4, 5}));
  EXPECT_EQ(curves.spheres[2].x, 9.0f);
  EXPECT_EQ(curves.labels.of(2), "4");
}

TEST(XyzReader, WarnsOfWhatItAssumes) {
  EXPECT_EQ(read_text("a.xyz", "0 0 0\n\n1.5 0 0\n").warnings.size(), 1u);
  EXPECT_EQ(read_text("a.xyz", "C 0 0 0\nC 1 1 0\n").warnings.size(), 1u);
  EXPECT_TRUE(read_text("a.xyz", "0 0 0\n1 1 0\n\n").warnings.empty());
}

TEST(XyzReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("2: the row has 2 columns, not 3", "a.xyz", "0 0 0\n1 1\n");
  EXPECT_COMPLAINT("1: 5 points are announced, 2 follow", "a.xyz", "5\nt\n0 0 0\n1 1 1\n");
  EXPECT_COMPLAINT("1: 2 points are announced, 1 follow", "a.xyz", "2\nt\n0 0 0\n2\nt\n0 0 0\n1 0 0\n");
  EXPECT_COMPLAINT("2: y 'nan' is not a finite number", "a.xyz", "0 0 0\n0 nan 0\n");
  EXPECT_COMPLAINT("1: x '1e40' is too large", "a.xyz", "1e40 0 0\n");
  EXPECT_COMPLAINT("1: number of points '-3'", "a.xyz", "-3\n0 0 0\n");
  EXPECT_COMPLAINT(" holds no points", "a.xyz", "# nothing\n");
  EXPECT_COMPLAINT(" holds no points", "a.xyz", "0\n\n");
}

RC_GTEST_PROP(XyzReader, BringsEveryFloatBack, ()) {
  std::vector<Sphere> spheres;
  std::string text;
  for (auto left = *rc::gen::inRange(1, 6); left > 0; --left) {
    const Sphere& s = spheres.emplace_back(Sphere{*any_finite(), *any_finite(), *any_finite(), 0});
    append_shortest(text, s.x), text += ' ';
    append_shortest(text, s.y), text += ' ';
    append_shortest(text, s.z), text += '\n';
  }
  RC_ASSERT(read_text("a.txt", text).spheres == spheres);
}

}  // namespace
}  // namespace catena
