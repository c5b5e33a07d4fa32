#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

TEST(CsvReader, FindsColumnsByName) {
  for (const char* text :
       {"x,y,z,r\n1,2,3,4\n", "# c\n\nRadius,Z,Y,X\n4,3,2,1\n", "name;x [mm];y(mm);z;d\nA;1;2;3;8\r\n",
        "\"x\",\"y\",\"z\",\"note\",\"diameter\"\n\"1\",2,3,\"a, b\",8,,\n", "x\ty\tz\tr\n1\t2\t3\t+4\n"}) {
    const CurveFile curves = read_text("a.csv", text);
    ASSERT_EQ(curves.spheres.size(), 1u) << text;
    EXPECT_EQ(curves.spheres[0], (Sphere{1, 2, 3, 4})) << text;
    EXPECT_TRUE(curves.has_radii);
  }
  EXPECT_FALSE(read_text("a.csv", "x,y,z\n1,2,3\n").has_radii);
}

/// A comma parts the header whatever else stands in a name of it, and before a tab a semicolon does.
TEST(CsvReader, TakesTheFirstSeparatorThatItsHeaderHas) {
  for (const char* text :
       {"x,y,z,r,a;b\n1,2,3,4,5;6\n", "x,a\tb,y,z,r\n1,5\t6,2,3,4\n", "x;y;z;r;a\tb\n1;2;3;4;5\t6\n"}) {
    const CurveFile curves = read_text("a.csv", text);
    ASSERT_EQ(curves.spheres.size(), 1u) << text;
    EXPECT_EQ(curves.spheres[0], (Sphere{1, 2, 3, 4})) << text;
  }
}

TEST(CsvReader, StartsAStrandWhereTheStrandColumnChanges) {
  for (const std::string name : {"strand", "chain", "Chain", "chr"}) {
    const auto curves = read_text("a.csv", name + ",x,y,z\na,0,0,0\na,1,0,0\nb,2,0,0\n");
    EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2, 3})) << name;
    EXPECT_EQ(curves.labels.strand_names, (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(curves.warnings.empty());
  }
}

TEST(CsvReader, GathersTheRowsOfAStrandThatComesBackAndSaysSo) {
  const auto curves = read_text("a.csv", "strand,x,y,z\na,0,0,0\nb,5,0,0\na,1,0,0\nb,6,0,0\na,2,0,0\n");
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 3, 5}));
  std::vector<float> x;
  std::vector<std::string> lines;
  for (std::uint32_t i = 0; i < 5; ++i)
    x.push_back(curves.spheres[i].x), lines.push_back(curves.labels.of(i));
  EXPECT_EQ(x, (std::vector<float>{0, 1, 2, 5, 6}));
  EXPECT_EQ(lines, (std::vector<std::string>{"2", "4", "6", "3", "5"}));
  ASSERT_EQ(curves.warnings.size(), 1u);
  EXPECT_EQ(curves.warnings[0],
            "line 4: a strand comes back after another, 3 times in all; the rows of a name are one strand");
  EXPECT_EQ(
      read_text("a.csv", "strand,x,y,z\na,0,0,0\nb,5,0,0\na,1,0,0\n").warnings,
      std::vector<std::string>{"line 4: a strand comes back after another, 1 time in all; the rows of a "
                               "name are one strand"});
}

RC_GTEST_PROP(CsvReader, TakesTheRowsOfANameInTheirOrder, ()) {
  const auto names =
      *rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::elementOf(std::string("abc"))));
  std::string text = "x,y,z,strand,closed\n", seen;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += std::to_string(i) + ",0,0," + names[i] + (names[i] == 'b' ? ",1\n" : ",0\n");
    if (seen.find(names[i]) == std::string::npos) seen += names[i];
  }
  const CurveFile curves = read_text("a.csv", text);
  RC_ASSERT(curves.strand_closed.size() == seen.size());
  std::size_t i = 0;
  for (std::size_t s = 0; s < seen.size(); ++s) {
    RC_ASSERT(curves.labels.strand_names[s] == std::string(1, seen[s]));
    RC_ASSERT(curves.strand_closed[s] == (seen[s] == 'b'));
    for (std::size_t row = 0; row < names.size(); ++row)
      if (names[row] == seen[s]) {
        RC_ASSERT(curves.spheres[i].x == static_cast<float>(row));
        RC_ASSERT(curves.labels.of(static_cast<std::uint32_t>(i)) == std::to_string(row + 2));
        ++i;
      }
    RC_ASSERT(curves.strand_first[s + 1] == i);
  }
}

TEST(CsvReader, NamesTheColumnsThatItDoesNotRead) {
  const auto curves = read_text("a.csv", "x,y,z,pressure,\"a,b\"\n0,0,0,1,2\n");
  ASSERT_EQ(curves.warnings.size(), 1u);
  EXPECT_EQ(curves.warnings[0], "not read: columns 'pressure', 'a,b'");
  using Texts = std::vector<std::string>;
  EXPECT_EQ(read_text("a.csv", "x,y,z,p\n0,0,0,1\n").warnings, Texts{"not read: column 'p'"});
  const std::string six = "x,y,z,a,b,c,e,f,g", named = "'a', 'b', 'c', 'e', 'f', 'g'";
  EXPECT_EQ(read_text("a.csv", six + "\n0,0,0,1,1,1,1,1,1\n").warnings, Texts{"not read: columns " + named});
  EXPECT_EQ(read_text("a.csv", six + ",h\n0,0,0,1,1,1,1,1,1,1\n").warnings,
            Texts{"not read: columns " + named + ", ..."});
}

TEST(CsvReader, TakesADoubledQuotationMarkForOne) {
  const auto curves =
      read_text("a.csv", "id,x,y,z\n\"5\"\",\"\"\",0,0,0\n \" a \" ,1,0,0\n\"\",2,0,0\n5\"x,3,0,0\n");
  std::vector<std::string> ids;
  for (std::uint32_t i = 0; i < 4; ++i) ids.push_back(curves.labels.of(i));
  EXPECT_EQ(ids, (std::vector<std::string>{"5\",\"", " a ", "", "5\"x"}));
  for (const char* cell : {"\"a", "\"a\"b", "\"a\"\"", "\""})
    EXPECT_COMPLAINT("2: a quotation mark is not closed", "a.csv",
                     std::string("id,x,y,z\n") + cell + ",0,0,0\n");
}

TEST(CsvReader, LabelsSpheresByTheirIdOrElseByTheirLine) {
  EXPECT_EQ(read_text("a.csv", "# c\nx,y,z\n0,0,0\n\n1,0,0\n").labels.of(1), "5");
  EXPECT_EQ(read_text("a.csv", "x,y,z,id\n0,0,0,p7\n1,0,0,p3\n").labels.of(1), "p3");
}

TEST(CsvReader, TakesTheColumnsThatTheUserNames) {
  const TestFile bare("a.csv", "1,2,3,4\n5,6,7,8\n"), headed("b.csv", "a,b,c,d\n1,2,3,4\n5,6,7,8\n");
  for (const TestFile* file : {&bare, &headed}) {
    const auto curves = ReaderRegistry::instance().read(file->path(), {.columns = {"z", "y", "x", "r"}});
    EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{3, 2, 1, 4}, {7, 6, 5, 8}}));
  }
  // A header has words for all three: any other first line is a point, and a damaged one is no header.
  for (const char* damaged : {"a,2,3\n1,2,3\n", "1,b,3\n1,2,3\n", "1,2,c\n1,2,3\n", "a,b,3\n1,2,3\n"}) {
    const TestFile file("a.csv", damaged);
    EXPECT_THROW(ReaderRegistry::instance().read(file.path(), {.columns = {"x", "y", "z"}}), InputError)
        << damaged;
  }
}

TEST(CsvReader, ReadsWhichStrandsAreClosed) {
  const auto curves = read_text("a.csv", "strand,closed,x,y,z\na,1,0,0,0\na,1,1,0,0\nb,0,2,0,0\n");
  EXPECT_EQ(curves.strand_closed, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_COMPLAINT("3: this strand is closed in one row and open in another", "a.csv",
                   "closed,x,y,z\n1,0,0,0\n0,1,0,0\n");
  EXPECT_COMPLAINT("2: closed 'yes' must be 0 or 1", "a.csv", "closed,x,y,z\nyes,0,0,0\n");
  EXPECT_COMPLAINT("4: strand 'a' is closed in one row and open in another", "a.csv",
                   "strand,closed,x,y,z\na,1,0,0,0\nb,1,0,0,0\na,0,0,0,0\n");
}

TEST(CsvReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("1: columns 'x (mm)' and 'r (um)' tell different units", "a.csv",
                   "x (mm),y (mm),z (mm),r (um)\n0,0,0,1\n");
  EXPECT_COMPLAINT("1: columns 'z (mm)' and 'd (um)' tell different units", "a.csv",
                   "x,y,z (mm),d (um)\n0,0,0,1\n");
  EXPECT_TRUE(complaint("a.csv", "x (mm),y [mm],z,r( mm ),id (um)\n0,0,0,1,a\n").empty());
  EXPECT_COMPLAINT("1: the columns must name x, y and z", "a.csv", "1,2,3\n");
  EXPECT_COMPLAINT("1: columns 1 and 2 mean the same", "a.csv", "x,X,y,z\n");
  EXPECT_COMPLAINT("1: columns 1 and 2 mean the same", "a.csv", "strand,chain,x,y,z\n");
  EXPECT_COMPLAINT("1: both a radius and a diameter", "a.csv", "x,y,z,r,d\n");
  EXPECT_COMPLAINT("3: the row has 2 columns, not 3", "a.csv", "x,y,z\n1,2,3\n1,2\n");
  EXPECT_COMPLAINT("3: the row has 5 columns, not 3", "a.csv", "x,y,z\n1,2,3,,\n1,2,3,,4\n");
  EXPECT_COMPLAINT("2: z '' is not a number", "a.csv", "x,y,z\n1,2,\n");
  EXPECT_COMPLAINT("2: radius '-1' is negative", "a.csv", "x,y,z,r\n1,2,3,-1\n");
  EXPECT_COMPLAINT("2: radius '0.1e-300' is no 0", "a.csv", "x,y,z,r\n1,2,3,0.1e-300\n");
  EXPECT_COMPLAINT("2: diameter '1.4e-45' is no 0", "a.csv", "x,y,z,d\n1,2,3,1.4e-45\n");
  EXPECT_COMPLAINT(" holds no points", "a.csv", "x,y,z\n");
}

}  // namespace
}  // namespace catena
