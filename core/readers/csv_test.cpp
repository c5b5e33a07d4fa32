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

TEST(CsvReader, StartsAStrandWhereTheStrandColumnChanges) {
  const auto curves = read_text("a.csv", "strand,x,y,z\na,0,0,0\na,1,0,0\nb,2,0,0\n");
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(CsvReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("1: the header must name", "a.csv", "1,2,3\n");
  EXPECT_COMPLAINT("1: columns 1 and 2 mean the same", "a.csv", "x,X,y,z\n");
  EXPECT_COMPLAINT("1: both a radius and a diameter", "a.csv", "x,y,z,r,d\n");
  EXPECT_COMPLAINT("3: the row has 2 columns, the header 3", "a.csv", "x,y,z\n1,2,3\n1,2\n");
  EXPECT_COMPLAINT("2: z '' is not a number", "a.csv", "x,y,z\n1,2,\n");
  EXPECT_COMPLAINT("2: radius '-1' is negative", "a.csv", "x,y,z,r\n1,2,3,-1\n");
  EXPECT_COMPLAINT(" holds no points", "a.csv", "x,y,z\n");
}

}  // namespace
}  // namespace catena
