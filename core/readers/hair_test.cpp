#include <bit>
#include <limits>

#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

std::string little(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
  return text;
}
std::string little(float value) { return little(std::bit_cast<std::uint32_t>(value), 4); }

struct Header {
  std::uint32_t strands = 2, points = 5, arrays = 3, segments = 0;
  float thickness = 0;
};

std::string header(const Header& h) {
  std::string text = "HAIR" + little(h.strands, 4) + little(h.points, 4) + little(h.arrays, 4) +
                     little(h.segments, 4) + little(h.thickness);
  text.resize(128, '\0');
  return text;
}

std::string floats(int count, float start = 0) {
  std::string text;
  for (int i = 0; i < count; ++i) text += little(start + static_cast<float>(i));
  return text;
}

const std::string segments_2_1 = little(2, 2) + little(1, 2);

TEST(HairReader, ReadsStrandsBySegments) {
  const auto curves = read_text("a.hair", header({}) + segments_2_1 + floats(15));
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 3, 5}));
  EXPECT_EQ(curves.spheres[4], (Sphere{12, 13, 14, 0}));
  EXPECT_FALSE(curves.has_radii);
  EXPECT_EQ(read_text("a.hair", header({}) + segments_2_1 + floats(15) + "xy").warnings,
            std::vector<std::string>{"2 bytes after the last array not read"});
}

TEST(HairReader, ThicknessIsADiameter) {
  const auto own = read_text(
      "a.hair", header({2, 5, 3 | 4 | 8 | 16}) + segments_2_1 + floats(15) + floats(5, 1) + floats(20));
  EXPECT_TRUE(own.has_radii);
  EXPECT_EQ(own.spheres[4].radius, 2.5f);
  EXPECT_TRUE(own.warnings.empty());
  for (const float unused : {-1.0f, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(read_text("a.hair", header({2, 5, 3 | 4, 0, unused}) + segments_2_1 + floats(15) + floats(5, 1))
                  .spheres[4]
                  .radius,
              2.5f);
  const auto common = read_text("a.hair", header({2, 5, 3, 0, 0.5f}) + segments_2_1 + floats(15));
  EXPECT_TRUE(common.has_radii);
  EXPECT_EQ(common.spheres[4].radius, 0.25f);
}

/// What an origin leaves over when it is rounded is a share of the sphere's own radius, which comes later.
TEST(HairReader, KnowsWhichSphereLosesMostOfItsRadius) {
  const TestFile file("a.hair",
                      header({1, 3, 2 | 4, 2}) + floats(9) + little(8.0f) + little(0.5f) + little(2.0f));
  const auto rounding = [&](double z) {
    return ReaderRegistry::instance()
        .read(file.path(), {.recentre = true, .origin = std::array<double, 3>{0, 0, z}})
        .rounding;
  };
  EXPECT_EQ(rounding(-1e9).greatest_error(), 8);  // of 2, 5 and 8 beyond 1e9, where floats are 64 apart
  EXPECT_EQ(rounding(-1e9).greatest_share(), 5 / 0.25);
  EXPECT_EQ(rounding(0).greatest_share(), 0);
}

TEST(HairReader, TakesTheDefaultCount) {
  const auto curves = read_text("a.hair", header({2, 6, 2, 2}) + floats(18));
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 3, 6}));
}

TEST(HairReader, ComplainsOfWhatDoesNotFit) {
  const std::string whole = header({}) + segments_2_1 + floats(15);
  EXPECT_COMPLAINT(" byte 4: the first four bytes are not HAIR", "a.hair", "HAIL" + whole);
  for (std::size_t size = 1; size < whole.size(); ++size)
    EXPECT_NE(complaint("a.hair", whole.substr(0, size)), "") << size;
  EXPECT_COMPLAINT(" byte 128: the header announces no array of points", "a.hair",
                   header({2, 5, 1}) + segments_2_1);
  EXPECT_COMPLAINT(" byte 132: strands: 2, with points: 5, but the header says", "a.hair",
                   header({2, 6, 3}) + segments_2_1);
  EXPECT_COMPLAINT(" byte 128: the file is truncated: 0 bytes left, too few for 4294967295", "a.hair", header({~0u, ~0u, 2, ~0u}));
  EXPECT_COMPLAINT(" byte 128: the file is truncated: 0 bytes left, too few for 4294967295", "a.hair", header({~0u, ~0u, 3}));
  EXPECT_COMPLAINT(" byte 128: the file is truncated: 12 bytes left, too few for 4294967295", "a.hair",
                   header({1, ~0u, 2, ~0u - 1}) + floats(3));
  const std::string nan = little(std::numeric_limits<float>::quiet_NaN());
  EXPECT_COMPLAINT(" byte 132: y is nan", "a.hair", header({1, 2, 2, 1}) + floats(1) + nan + floats(4));
  const std::string infinite = little(-std::numeric_limits<float>::infinity());
  EXPECT_COMPLAINT(" byte 132: y is -inf", "a.hair", header({1, 2, 2, 1}) + floats(1) + infinite + floats(4));
  EXPECT_COMPLAINT(" byte 24: the thickness -1", "a.hair",
                   header({2, 5, 3, 0, -1}) + segments_2_1 + floats(15));
  EXPECT_COMPLAINT(" holds no points", "a.hair", header({0, 0, 2}));
}

}  // namespace
}  // namespace catena
