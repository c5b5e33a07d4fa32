#include <fmt/format.h>

#include <bit>

#include "catena/core/readers/test_file.h"

/// Arrays of VTK's legacy files: how they are named, of what they are, in what order.
namespace catena {
namespace {

std::string file(const std::string& version, const std::string& form, const std::string& rest) {
  return fmt::format("# vtk DataFile Version {}\nt\n{}\nDATASET POLYDATA\n{}", version, form, rest);
}

void big_endian(std::string& bytes, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 255);
}

TEST(VtkLegacyArrays, AreNamedAsTheirOddCharactersAreWritten) {
  const std::string text =
      file("3.0", "ASCII",
           "POINTS 2 float\n0 0 0 1 0 0\nLINES 1 3\n2 0 1\nPOINT_DATA 2\nFIELD f 2\nmy%20radius 1 2 float\n3 4\n"
           "the%2Dradius%2 1 2 float\n5 6\n");
  const TestFile named("a.vtk", text);
  const auto radius = [&](const std::string& array) {
    return ReaderRegistry::instance().read(named.path(), {.array = array}).spheres[1].radius;
  };
  EXPECT_EQ(radius("my radius"), 4.0f);
  EXPECT_EQ(radius("the-radius%2"), 6.0f);
}

TEST(VtkLegacyArrays, OfWholeNumbersKeepTheirSigns) {
  const auto read_radii = [](const std::string& type, std::uint32_t first) {
    std::string points = "POINTS 2 float\n";
    for (const float x : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f}) big_endian(points, std::bit_cast<std::uint32_t>(x));
    points += "\nLINES 1 3\n";
    for (const std::uint32_t number : {2, 0, 1}) big_endian(points, number);
    points += "\nPOINT_DATA 2\nSCALARS radius " + type + "\nLOOKUP_TABLE default\n";
    big_endian(points, first), big_endian(points, 7);
    return file("3.0", "BINARY", points);
  };
  EXPECT_EQ(read_text("a.vtk", read_radii("int", 5)).spheres[0].radius, 5.0f);
  EXPECT_EQ(read_text("a.vtk", read_radii("unsigned_int", ~0u)).spheres[0].radius, 4294967295.0f);
  const std::string said = complaint("a.vtk", read_radii("int", ~0u));
  EXPECT_NE(said.find("'radius' of point 0 is -1, no radius"), std::string::npos) << said;
}

TEST(VtkLegacyArrays, OfOffsetsAscend) {
  const auto offsets = [](const std::string& middle) {
    return file("5.1", "ASCII",
                fmt::format("POINTS 3 float\n0 0 0 1 0 0 2 0 0\nLINES 4 3\nOFFSETS vtktypeint64\n0 {} 3\nCONNECTIVITY "
                            "vtktypeint64\n0 1 2\n",
                            middle));
  };
  EXPECT_EQ(complaint("a.vtk", offsets("1 2")), "");
  EXPECT_EQ(complaint("a.vtk", offsets("2 2")), "");
  const std::string said = complaint("a.vtk", offsets("2 1"));
  EXPECT_TRUE(said.starts_with("a.vtk:9: offset 2 is 1; offsets ascend from 0 to 3")) << said;
}

}  // namespace
}  // namespace catena
