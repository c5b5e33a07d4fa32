#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

using Offsets = std::vector<std::uint32_t>;

float first_x(std::string_view text) { return read_text("a.xyz", text).spheres.at(0).x; }

TEST(XyzReader, ReadsTheDialects) {
  const char* dialects[] = {"7 0 0\n8 0.5 0\n",            // bare
                            "2\n7 0 0\n8 0 0\n",           // count
                            "2\n\n7 0 0\n8 0 0\n",         // count and blank title
                            "2\ntitle 1\n7 0 0\n8 0 0\n",  // count and title
                            "2\n1 2 3\n7 0 0\n8 0 0\n",    // count and a title of numbers
                            "knot 3_1\n7 0 0\n8 0 0\n",    // title
                            "C 7 0 0\nC 8 0 0\n",          // element
                            "1 7 0 0\n5 8 0 0\nEND\n",     // id
                            "2\nt\n6 7 0 0\n6 8 0 0\n",    // atomic number under a count
                            "7.0 0 0 0.1\n7.0 1 0 0.2\n",  // a fourth column
                            "7,0,0\n8,0,0\n",
                            "7 0 0 # c\r\n8 0 0\r\n"};
  for (const char* text : dialects) {
    EXPECT_EQ(first_x(text), 7.0f) << text;
    EXPECT_EQ(read_text("a.txt", text).strand_first, (Offsets{0, 2})) << text;
    EXPECT_FALSE(read_text("a.txt", text).has_radii);
  }
}

TEST(XyzReader, EndEndsAStrand) {
  const auto curves = read_text("a.xyz", "1 7 0 0\n2 8 0 0\nEND\n1 9 0 0\n2 9 1 0\nend\n");
  EXPECT_EQ(curves.strand_first, (Offsets{0, 2, 4}));
  EXPECT_EQ(curves.spheres[2].x, 9.0f);
}

TEST(XyzReader, WarnsOfWhatItAssumes) {
  EXPECT_EQ(read_text("a.xyz", "0 0 0 1.5\n1.5 0 0 1\n").warnings.size(), 1u);
  EXPECT_EQ(read_text("a.xyz", "1 0 0 1.5\n2 0 0 1\n").warnings.size(), 1u);
  EXPECT_EQ(read_text("a.xyz", "0 0 0\n\n1.5 0 0\n").warnings.size(), 1u);
  EXPECT_EQ(read_text("a.xyz", "1\n\n0 0 0\n1\n\n0 0 0\n").warnings.size(), 1u);
  EXPECT_TRUE(read_text("a.xyz", "0 0 0\n1 1 0\n\n").warnings.empty());
}

TEST(XyzReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("2: a point needs three coordinates, got 2", "a.xyz", "0 0 0\n1 1\n");
  EXPECT_COMPLAINT("3: 4 columns of numbers, but line 1 has 3", "a.xyz", "0 0 0\n\n1 1 1 1\n");
  EXPECT_COMPLAINT("1: 5 points are announced, 2 follow", "a.xyz", "5\nt\n0 0 0\n1 1 1\n");
  EXPECT_COMPLAINT("2: y 'nan' is not a finite number", "a.xyz", "0 0 0\n0 nan 0\n");
  EXPECT_COMPLAINT("1: x '1e40' is too large", "a.xyz", "1e40 0 0\n");
  EXPECT_COMPLAINT("2: a point needs three", "a.xyz", "title\nsecond title\n0 0 0\n");
  EXPECT_COMPLAINT("1: number of points '-3'", "a.xyz", "-3\n0 0 0\n");
  EXPECT_COMPLAINT(" holds no points", "a.xyz", "title\n");
  EXPECT_COMPLAINT(" holds no points", "a.xyz", "0\n\n");
}

}  // namespace
}  // namespace catena
