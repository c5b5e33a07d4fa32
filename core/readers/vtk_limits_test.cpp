#include <fmt/format.h>

#include <cstring>
#include <limits>

#include "catena/core/readers/test_file.h"
#include "catena/reports/base64.h"

/// What VTK's files may not say, and what of them is not looked at.
namespace catena {
namespace {

void expect_says(const std::string& said, const std::string& words) {
  EXPECT_NE(said.find(words), std::string::npos) << "got '" << said << "' instead of '" << words << "'";
}

std::string legacy(const std::string& form, const std::string& rest) {
  return "# vtk DataFile Version 5.1\nt\n" + form + "\nDATASET POLYDATA\n" + rest;
}
const std::string four = "POINTS 4 float\n0 0 0 1 0 0 2 0 0 3 0 0\n", lines = "LINES 2 6\n2 0 1 2 1 2\n";

template <class T>
std::string big_endian(const std::vector<T>& values) {
  std::string bytes;
  for (const T value : values) {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    bytes.append(raw.rbegin(), raw.rend());
  }
  return bytes;
}

TEST(VtkLegacyReader, RefusesCellsThatAreNone) {
  expect_says(complaint("a.vtk", legacy("ASCII", four + "LINES 2 3\n2 0 1\n")),
              "2 cells do not fit into the 3 numbers announced");
  expect_says(complaint("a.vtk", legacy("ASCII", four + "LINES 1 3\n-1 0 1\n")), "a cell of -1 points");
  expect_says(complaint("a.vtk", legacy("ASCII", four + "LINES 2 2\nOFFSETS int\n0 2\nPOINTS int\n0 1\n")),
              "CONNECTIVITY is due after OFFSETS");
  expect_says(complaint("a.vtk",
                        legacy("ASCII", four + lines + "POINT_DATA 3\nFIELD f 1\nradius 1 3 float\n1 1 1\n")),
              "'radius' has 3 values for 4 points");
}

TEST(VtkLegacyReader, TakesTheLargestOfLinesInAnyOrder) {
  const CurveFile curves =
      read_text("a.vtk", legacy("ASCII", four + lines + "CELL_DATA 2\nFIELD f 1\nradius 1 2 float\n3 1\n"));
  EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{0, 0, 0, 3}, {1, 0, 0, 3}, {2, 0, 0, 1}}));
}

TEST(VtkLegacyReader, TakesRadiiUpToTheGreatestFloat) {
  const auto of = [](const std::string& radius) {
    return legacy("ASCII",
                  four + lines + "POINT_DATA 4\nFIELD f 1\nradius 1 4 double\n" + radius + " 1 1 1\n");
  };
  constexpr float greatest = std::numeric_limits<float>::max();
  EXPECT_EQ(read_text("a.vtk", of(fmt::format("{}", double{greatest}))).spheres[0].radius, greatest);
  expect_says(complaint("a.vtk", of("3.4028235e38")), "'radius' of point 0 is 3.4028235e+38, no radius");
}

TEST(VtkLegacyReader, ReadsPointsWithoutAnyLine) {
  EXPECT_EQ(read_text("a.vtk", legacy("ASCII", four + "VERTICES 2 4\n1 0\n1 2\n")).spheres,
            (std::vector<Sphere>{{0, 0, 0, 0}, {2, 0, 0, 0}}));
}

TEST(VtkLegacyReader, DecodesNamesToTheirEnd) {
  for (const char* name : {"radiu%73", "%72adius", "ra%64ius"})
    EXPECT_TRUE(read_text("a.vtk", legacy("ASCII", four + lines + "POINT_DATA 4\nFIELD f 1\n" + name +
                                                       " 1 4 float\n1 2 3 4\n"))
                    .has_radii)
        << name;
}

TEST(VtkLegacyReader, ReadsBinaryNumbersOfEveryKind) {
  const std::string points = "POINTS 2 float\n" + big_endian<float>({0, 0, 0, 1, 0, 0}) + "\nLINES 1 3\n" +
                             big_endian<std::int32_t>({2, 0, 1}) + "\nPOINT_DATA 2\nFIELD f 1\n";
  const auto radii = [&](const std::string& type, const std::string& bytes) {
    return legacy("BINARY", points + "radius 1 2 " + type + "\n" + bytes);
  };
  EXPECT_EQ(read_text("a.vtk", radii("short", big_endian<std::int16_t>({3, 300}))).spheres[1].radius, 300);
  EXPECT_EQ(read_text("a.vtk", radii("unsigned_char", big_endian<std::uint8_t>({3, 200}))).spheres[1].radius,
            200);
  const std::pair<const char*, std::string> greatest[] = {
      {"unsigned_short", big_endian<std::uint16_t>({3, 0xffff})},
      {"unsigned_int", big_endian<std::uint32_t>({3, 0xffffffff})},
      {"unsigned_long", big_endian<std::uint64_t>({3, 0x7fffffffffffffff})}};
  float top = 0x1p16f - 1;
  for (const auto& [type, bytes] : greatest) {
    EXPECT_EQ(read_text("a.vtk", radii(type, bytes)).spheres[1].radius, top) << type;
    top = top == 0x1p32f ? 0x1p63f : 0x1p32f;
  }
  expect_says(complaint("a.vtk", radii("short", big_endian<std::int16_t>({3, -1}))),
              "of point 1 is -1, no radius");
  expect_says(complaint("a.vtk", radii("char", big_endian<std::int8_t>({-2, 1}))),
              "of point 0 is -2, no radius");
  expect_says(complaint("a.vtk", legacy("BINARY", "POINTS 1 double\n" + big_endian<double>({0, 1e300, 0}))),
              "y is 1e+300, no finite 32-bit float");
  expect_says(
      complaint("a.vtk", legacy("BINARY", "POINTS 1 float\n" + big_endian<float>({0, 0, 0}) +
                                              "\nLINES 1 0\nOFFSETS float\n" + big_endian<float>({0}))),
      "offset is of a floating type");
}

std::string xml(const std::string& kind, const std::string& piece, const std::string& attributes = "") {
  return fmt::format("<VTKFile type=\"{0}\"{1}><{0}>{2}</{0}></VTKFile>", kind, attributes, piece);
}
const std::string two = "<Points><DataArray type=\"Float32\">0 0 0 1 0 0</DataArray></Points>",
                  line =
                      "<Lines><DataArray Name=\"connectivity\">0 1</DataArray><DataArray "
                      "Name=\"offsets\">2</DataArray></Lines>";

/// An array in base64, behind its size in four bytes.
template <class T>
std::string binary(const std::string& name, const std::string& type, const std::vector<T>& values,
                   std::uint32_t bytes = 0) {
  std::string data(4 + values.size() * sizeof(T), '\0');
  const std::uint32_t size = bytes > 0 ? bytes : static_cast<std::uint32_t>(values.size() * sizeof(T));
  std::memcpy(data.data(), &size, 4);
  std::memcpy(data.data() + 4, values.data(), values.size() * sizeof(T));
  return fmt::format("<DataArray Name=\"{}\" type=\"{}\" format=\"binary\">{}</DataArray>", name, type,
                     reports::base64(std::span<const char>(data)));
}
std::string piece(const std::string& rest) { return "<Piece>" + rest + "</Piece>"; }

/// A writer may name an array that it has no components of; then nothing stands there.
TEST(VtkLegacyReader, TakesArraysOfNoComponents) {
  const std::string points = big_endian<float>({0, 0, 0, 5, 0, 0}),
                    cell = big_endian<std::int32_t>({2, 0, 1}),
                    radii = "\nradius 1 2 float\n" + big_endian<float>({1, 2});
  for (const std::string& empty : std::vector<std::string>{
           "FIELD f 2\nnone 0 2 float\n" + radii,
           "SCALARS s float 0\nLOOKUP_TABLE default\n\nFIELD f 1" + radii,
           "COLOR_SCALARS c 0\n\nFIELD f 1" + radii, "TEXTURE_COORDINATES t 0 float\n\nFIELD f 1" + radii})
    EXPECT_EQ(read_text("a.vtk", legacy("BINARY", "POINTS 2 float\n" + points + "\nLINES 1 3\n" + cell +
                                                      "\nPOINT_DATA 2\n" + empty))
                  .spheres,
              (std::vector<Sphere>{{0, 0, 0, 1}, {5, 0, 0, 2}}))
        << empty;
}

TEST(VtkXmlReader, RefusesNumbersThatAreNone) {
  expect_says(complaint("a.vtp", xml("PolyData", piece(two + line), " header_type=\"UInt16\"")),
              "the header_type 'UInt16' is not known");
  expect_says(complaint("a.vtp", xml("PolyData", piece("<Points><DataArray>0 0 0 1 0</DataArray></Points>"))),
              "5 coordinates are no points of three");
  const float infinity = std::numeric_limits<float>::infinity();
  expect_says(
      complaint("a.vtp",
                xml("PolyData", piece("<Points>" + binary<float>("p", "Float32", {0, 0, 0, 1, infinity, 0}) +
                                      "</Points>"))),
      "y of point 1 is inf, no finite 32-bit float");
  expect_says(complaint("a.vtp", xml("PolyData", piece("<Points>" + binary<float>("p", "Float32", {0, 0}, 6) +
                                                       "</Points>"))),
              "6 bytes cannot be numbers of 4");
  expect_says(
      complaint("a.vtp", xml("PolyData", "<Piece NumberOfPolys=\"4294967296\">" + two + line + "</Piece>")),
      "NumberOfPolys '4294967296' is no number that a file can have");
  expect_says(
      complaint("a.vtp", xml("PolyData",
                             piece(two + "<Lines>" + binary<std::int32_t>("connectivity", "Int32", {0, -1}) +
                                   "<DataArray Name=\"offsets\">2</DataArray></Lines>"))),
      "point number -1 is not one of 2 from 0");
}

TEST(VtkXmlReader, RefusesCellTypesThatDoNotFit) {
  const auto cells = [](const std::string& types) {
    return xml("UnstructuredGrid", piece(two +
                                         "<Cells><DataArray Name=\"connectivity\">0 1</DataArray><DataArray "
                                         "Name=\"offsets\">2</DataArray><DataArray Name=\"types\">" +
                                         types + "</DataArray></Cells>"));
  };
  EXPECT_EQ(complaint("a.vtu", cells("3")), "");
  expect_says(complaint("a.vtu", cells("3 3")), "1 cell, but 2 cell types");
  expect_says(complaint("a.vtu", cells("259")), "cell type 259 is not one of 256 from 0");
}

/// Nor are they decoded: of another type, or damaged, they are in nobody's way.
TEST(VtkXmlReader, LeavesArraysAloneThatAreNoRadii) {
  const std::string names =
      "<PointData>" + binary<char>("names", "String", {'a', 'b'}) +
      "<DataArray Name=\"radius\" NumberOfComponents=\"2\">1 2 3 4</DataArray></PointData>";
  EXPECT_FALSE(read_text("a.vtp", xml("PolyData", piece(two + line + names))).has_radii);
}

TEST(VtkXmlReader, ReadsBinaryNumbersOfEveryKind) {
  const auto radius = [](const std::string& array) {
    return read_text("a.vtp", xml("PolyData", piece(two + line + "<PointData>" + array + "</PointData>")))
        .spheres[1]
        .radius;
  };
  EXPECT_EQ(radius(binary<double>("radius", "Float64", {1, 0.375})), 0.375f);
  EXPECT_EQ(radius(binary<float>("radius", "Float32", {1, 0.375f})), 0.375f);
  EXPECT_EQ(radius(binary<std::uint8_t>("radius", "UInt8", {1, 200})), 200);
  EXPECT_EQ(radius(binary<std::int16_t>("radius", "Int16", {1, 300})), 300);
}

}  // namespace
}  // namespace catena
