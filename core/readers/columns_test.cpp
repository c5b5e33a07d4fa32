#include <fmt/format.h>

#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"

/// Columns of text: x y z r, and genomes.
namespace catena {
namespace {

RC_GTEST_PROP(XyzrReader, ReadsWhatIsWritten, (bool commas)) {
  std::string text;
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> first{0};
  for (auto strands = *rc::gen::inRange(1, 4); strands > 0; --strands) {
    for (auto left = *rc::gen::inRange(1, 5); left > 0; --left) {
      const Sphere s{*any_finite(), *any_finite(), *any_finite(), std::abs(*any_finite())};
      text +=
          fmt::format(fmt::runtime(commas ? "{},{},{},{}\n" : " {}\t{} {} {}\n"), s.x, s.y, s.z, s.radius);
      spheres.push_back(s);
    }
    first.push_back(static_cast<std::uint32_t>(spheres.size()));
    text += "\n";
  }
  const CurveFile curves = read_text("a.xyzr", text);
  RC_ASSERT(curves.spheres == spheres);
  RC_ASSERT(curves.strand_first == first);
  RC_ASSERT(curves.has_radii);
}

TEST(XyzrReader, EndsAStrandAtABlankLineAndNotAtAComment) {
  const CurveFile curves = read_text("a.xyzr", "0 0 0 1\n# more of it\n1 0 0 1\n \t\n2 0 0 1\n");
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(XyzrReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("2: a point is 'x y z r', got 3 columns", "a.xyzr", "0 0 0 1\n1 0 0\n");
  EXPECT_COMPLAINT("1: a point is 'x y z r', got 5 columns", "a.xyzr", "0 0 0 1 2\n");
  EXPECT_COMPLAINT("1: radius '-1' is negative", "a.xyzr", "0 0 0 -1\n");
  EXPECT_COMPLAINT("1: radius '1e-46' is no 0, but binary32 has no radius so small", "a.xyzr",
                   "0 0 0 1e-46\n");
  EXPECT_EQ(read_text("a.xyzr", "# r\n0 0 0 1\n").labels.of(0), "2");
}

// Taken as if it were not there, an empty column would make the next one x.
TEST(TextColumns, RefuseAnEmptyOneInFrontOfAComma) {
  for (const char* row : {"1,,2,3", ",1,2,3", "1, ,2,3", "1 2,\t,3 4", "1,2,3,,"})
    for (const char* name : {"a.xyz", "a.xyzr", "a.3dg"})
      EXPECT_COMPLAINT("1: a column in front of a comma is empty", name, std::string(row) + "\n");
  EXPECT_COMPLAINT("3: a column in front of a comma is empty", "a.xyz", "1\nt,,t\n0,,0,0\n");
  EXPECT_COMPLAINT("2: a column in front of a comma is empty", "a.nucle3d", "CHR chr1\n0,,1,2,3\n");
  EXPECT_EQ(read_text("a.xyzr", "1 , 2,\t3 ,4,\n").spheres[0], (Sphere{1, 2, 3, 4}));
}

RC_GTEST_PROP(GenomeReaders, ReadWhatIsWritten, (bool table)) {
  std::string text = table ? "chr\tpos\tx\ty\tz\n" : "TITLE\ta cell\nGENOME\thg38\nBINSIZE\t1000\n";
  std::vector<Sphere> spheres;
  std::vector<std::string> labels;
  for (auto chromosomes = *rc::gen::inRange(1, 4), c = 0; c < chromosomes; ++c) {
    if (!table) text += fmt::format("CHR\tchr{}\n", c);
    int bin = 0;
    for (auto left = *rc::gen::inRange(1, 5); left > 0; --left) {
      bin += *rc::gen::inRange(1, 9);
      const Sphere s{*any_finite(), *any_finite(), *any_finite(), 0};
      text += table ? fmt::format("chr{}\t{}\t{}\t{}\t{}\n", c, bin, s.x, s.y, s.z)
                    : fmt::format("{},{},{},{}\n", bin, s.x, s.y, s.z);
      spheres.push_back(s);
      labels.push_back(fmt::format("chr{}:{}", c, bin));
    }
  }
  const CurveFile curves = read_text(table ? "a.3dg" : "a.nucle3d", text);
  RC_ASSERT(curves.spheres == spheres);
  for (std::uint32_t i = 0; i < labels.size(); ++i) RC_ASSERT(curves.labels.of(i) == labels[i]);
  RC_ASSERT(curves.labels.strand_names.size() == curves.strand_closed.size());
  for (std::size_t s = 0; s < curves.strand_closed.size(); ++s)
    RC_ASSERT(curves.labels.strand_names[s] == fmt::format("chr{}", s));
}

TEST(GenomeReaders, BeginAStrandForEachHaplotype) {
  const auto curves = read_text("a.nucle3d", "CHR chr1\n0,0,0,0,p\n1,1,0,0,p\n0,0,5,0,m\n");
  EXPECT_EQ(curves.labels.strand_names, (std::vector<std::string>{"chr1/p", "chr1/m"}));
  EXPECT_EQ(curves.labels.of(2), "chr1/m:0");
}

TEST(GenomeReaders, TakeRowsOfBlanksForPointsNotForHeaders) {
  EXPECT_EQ(read_text("a.nucle3d", "TITLE a b\nCHR chr1\n0,1,2,3\n1 2 3 4\n2,\t3, 4 5\n").spheres,
            (std::vector<Sphere>{{1, 2, 3, 0}, {2, 3, 4, 0}, {3, 4, 5, 0}}));
}

TEST(GenomeReaders, SkipNamesOfColumnsInCapitals) {
  EXPECT_EQ(read_text("a.3dg", "CHR\tPOS\tX\tY\tZ\nchr1\t5\t1\t2\t3\n").spheres,
            (std::vector<Sphere>{{1, 2, 3, 0}}));
}

TEST(GenomeReaders, TakeNoNoticeOfColumnsAfterTheFifth) {
  const CurveFile curves = read_text("a.3dg", "chr1 5 1 2 3 0.5 B\n");
  EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{1, 2, 3, 0}}));
  EXPECT_TRUE(curves.warnings.empty());
}

TEST(GenomeReaders, ComplainWithFileAndLine) {
  EXPECT_COMPLAINT("1: a chromosome is 'CHR name'", "a.nucle3d", "CHR chr 1\n0,0,0,0\n");
  EXPECT_COMPLAINT("2: position 'POS' is not a whole number", "a.3dg", "chr1 5 0 0 0\nCHR POS X Y Z\n");
  EXPECT_COMPLAINT("1: a point before the first 'CHR name'", "a.nucle3d", "0,0,0,0\n");
  EXPECT_COMPLAINT("2: a point is 'bin,x,y,z'", "a.nucle3d", "CHR chr1\n0,0,0\n");
  EXPECT_COMPLAINT("4: 'chr1/m' comes back after another", "a.nucle3d",
                   "CHR chr1\n0,0,0,0,m\n0,1,0,0,p\n1,0,1,0,m\n");
  EXPECT_COMPLAINT("5: 'chr1' comes back", "a.nucle3d", "CHR chr1\n0,0,0,0\nCHR chr2\nCHR chr1\n1,0,1,0\n");
  EXPECT_COMPLAINT("1: a row is 'chromosome position x y z', got 4 columns", "a.3dg", "chr1 0 0 0\n");
  EXPECT_COMPLAINT("2: position 5 of 'chr1' comes after 5", "a.3dg", "chr1 5 0 0 0\nchr1 5 1 0 0\n");
  EXPECT_COMPLAINT("3: chromosome 'chr1' comes back", "a.3dg", "chr1 5 0 0 0\nchr2 5 1 0 0\nchr1 6 1 0 0\n");
}

}  // namespace
}  // namespace catena
