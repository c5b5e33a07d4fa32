#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

using Offsets = std::vector<std::uint32_t>;

TEST(SwcReader, CutsATreeIntoStrandsTiedByJoints) {
  const CurveFile curves = read_text("a.swc",
                                     "# a Y with a longer stem\n"
                                     "1 1 0 0 0 1 -1\n"
                                     "2 3 1 0 0 1 1\n"
                                     "3 3 2 1 0 1 2\n"
                                     "4 3 2 -1 0 0 2\n"
                                     "5 3 3 -1 0 1 4\n");
  EXPECT_EQ(curves.strand_first, (Offsets{0, 3, 5}));
  EXPECT_EQ(curves.joints, (std::vector<Pair>{{1, 3}}));
  EXPECT_TRUE(curves.has_radii);
  EXPECT_EQ(curves.spheres[3], (Sphere{2, -1, 0, 0}));
  EXPECT_TRUE(curves.warnings.empty());
}

TEST(SwcReader, TakesAnyOrderIdsLineEndsAndBlanks) {
  const CurveFile curves = read_text("a.swc",
                                     "\xEF\xBB\xBF# head\r\n"
                                     "\r\n"
                                     "70 3 2 0 0 1 9 extra # comment\r\n"
                                     "\t9 3 1 0 0 1 0  \t\r\n"
                                     "0 3 0 0 0 +1 -1");
  EXPECT_EQ(curves.strand_first, (Offsets{0, 3}));
  for (float x : {0.f, 1.f, 2.f}) EXPECT_EQ(curves.spheres[static_cast<std::size_t>(x)].x, x);
}

TEST(SwcReader, StartsAStrandAtAMissingParentAndSaysSo) {
  const CurveFile curves =
      read_text("a.swc", "1 3 0 0 0 1 -1\n2 3 1 0 0 1 1\n3 3 5 0 0 1 77\n4 3 6 0 0 1 3\n");
  EXPECT_EQ(curves.strand_first, (Offsets{0, 2, 4}));
  EXPECT_TRUE(curves.joints.empty());
  ASSERT_EQ(curves.warnings.size(), 1u);
  EXPECT_NE(curves.warnings[0].find("line 3: sample 3 has the parent 77"), std::string::npos)
      << curves.warnings[0];
  EXPECT_EQ(read_text("a.swc", "1 3 0 0 0 1 -1\n3 3 5 0 0 1 77\n4 3 6 0 0 1 3\n5 3 7 0 0 1 78\n").warnings,
            std::vector<std::string>{"line 2: sample 3 has the parent 77, which is not in the file; 2 such "
                                     "samples start each a strand of its own"});
}

TEST(SwcReader, TiesManyBranchesToTheSampleTheyGrowFrom) {
  const CurveFile curves = read_text("a.swc",
                                     "1 1 0 0 0 1 -1\n2 3 1 0 0 1 1\n3 3 2 0 0 1 1\n4 3 3 0 0 1 1\n5 3 4 0 0 "
                                     "1 3\n6 3 5 0 0 1 3\n7 1 9 9 9 1 -1\n");
  EXPECT_EQ(curves.strand_first, (Offsets{0, 2, 4, 5, 6, 7}));
  EXPECT_EQ(curves.joints, (std::vector<Pair>{{0, 2}, {2, 4}, {0, 5}}));
}

TEST(SwcReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("2: a sample needs 7 columns", "a.swc", "1 1 0 0 0 1 -1\n2 3 1 0 0 1\n");
  EXPECT_COMPLAINT("3: id 1 is already that of line 1", "a.swc", "1 1 0 0 0 1 -1\n# x\n1 3 1 0 0 1 1\n");
  EXPECT_COMPLAINT("1: y 'nan'", "a.swc", "1 1 0 nan 0 1 -1\n");
  EXPECT_COMPLAINT("1: x '1e39' is too large", "a.swc", "1 1 1e39 0 0 1 -1\n");
  EXPECT_COMPLAINT("1: radius '-1' is negative", "a.swc", "1 1 0 0 0 -1 -1\n");
  EXPECT_COMPLAINT("1: id '1.5'", "a.swc", "1.5 1 0 0 0 1 -1\n");
  EXPECT_COMPLAINT("1: id -4 is negative", "a.swc", "-4 1 0 0 0 1 -1\n");
  EXPECT_COMPLAINT("1: sample 1 is its own ancestor", "a.swc", "1 1 0 0 0 1 1\n");
  EXPECT_COMPLAINT("4: sample 4 is its own ancestor", "a.swc",
                   "1 1 0 0 0 1 -1\n2 1 0 0 0 1 3\n3 1 0 0 0 1 4\n4 1 0 0 0 1 3\n");
  EXPECT_COMPLAINT(" holds no points", "a.swc", "# nothing\n");
  EXPECT_COMPLAINT(" is empty", "a.swc", "");
}

TEST(SwcReader, LabelsSpheresByTheIdsOfTheFile) {
  const CurveFile curves =
      read_text("a.swc", "30 1 0 0 0 1 -1\n7 3 1 0 0 1 30\n8 3 2 0 0 1 30\n9 3 3 0 0 1 7\n5 3 4 0 0 1 8\n");
  std::vector<std::string> ids;
  for (std::uint32_t i = 0; i < 5; ++i) ids.push_back(curves.labels.of(i));
  EXPECT_EQ(ids, (std::vector<std::string>{"30", "7", "9", "8", "5"}));
  EXPECT_EQ(curves.spheres[2].x, 3.0f);
  EXPECT_TRUE(curves.is_tree);
}

TEST(SwcReader, IsNotDeepInTheStack) {
  std::string text = "1 1 0 0 0 1 -1\n";
  for (int i = 2; i <= 200'000; ++i) text += std::to_string(i) + " 3 0 0 0 1 " + std::to_string(i - 1) + "\n";
  EXPECT_EQ(read_text("a.swc", text).strand_first, (Offsets{0, 200'000}));
}

}  // namespace
}  // namespace catena
