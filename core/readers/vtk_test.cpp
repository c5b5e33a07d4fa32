#include <fmt/format.h>

#include "catena/core/readers/test_bytes.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"

namespace catena {
namespace {

/// One of each kind of attribute of points that is skipped: what is read after it tells whether all of it
/// was.
std::string unread_attributes(std::size_t points, bool ascii) {
  std::string text;
  const auto add = [&](const std::string& line, std::size_t numbers, auto number) {
    text += "\n" + line + "\n";
    for (std::size_t k = 0; k < numbers; ++k)
      ascii ? text += fmt::format("{} ", number) : (append(text, number, true), text);
  };
  add("VECTORS velocity double", 3 * points, 0.5);
  add("NORMALS outward float", 3 * points, 0.5f);
  add("TENSORS strain float", 9 * points, 0.5f);
  add("TENSORS6 stress float", 6 * points, 0.5f);
  add("TEXTURE_COORDINATES skin 2 double", 2 * points, 0.5);
  add("GLOBAL_IDS ids vtkIdType", points, std::int32_t{5});
  add("SCALARS many short 3", 3 * points, std::int16_t{5});
  ascii ? add("COLOR_SCALARS hue 2", 2 * points, 0.5f)
        : add("COLOR_SCALARS hue 2", 2 * points, std::uint8_t{5});
  ascii ? add("LOOKUP_TABLE hues 3", 12, 0.5f) : add("LOOKUP_TABLE hues 3", 12, std::uint8_t{5});
  return text;
}

/// One line a cell of two points, which is what vascular tools write.
std::string legacy_of(const TestGraph& graph, bool ascii, bool version5, bool grid) {
  std::string text = fmt::format("# vtk DataFile Version {}\ntitle\n{}\nDATASET {}\nPOINTS {} float\n",
                                 version5 ? "5.1" : "3.0", ascii ? "ASCII" : "BINARY",
                                 grid ? "UNSTRUCTURED_GRID" : "POLYDATA", graph.points.size());
  const auto real = [&](float value) {
    ascii ? text += fmt::format("{} ", value) : (append(text, value, true), text);
  };
  const auto whole = [&](auto value) {
    ascii ? text += fmt::format("{} ", value) : (append(text, value, true), text);
  };
  for (const Sphere& p : graph.points) real(p.x), real(p.y), real(p.z);
  const char* cells = grid ? "CELLS" : "LINES";
  const auto count = graph.edges.size();
  if (version5) {
    text += fmt::format("\n{} {} {}\nOFFSETS vtktypeint64\n", cells, count + 1, 2 * count);
    for (std::size_t k = 0; k <= count; ++k) whole(static_cast<std::int64_t>(2 * k));
    text += "\nCONNECTIVITY vtktypeint64\n";
    for (const Pair& e : graph.edges) whole(std::int64_t{e.i}), whole(std::int64_t{e.j});
  } else {
    text += fmt::format("\n{} {} {}\n", cells, count, 3 * count);
    for (const Pair& e : graph.edges)
      whole(std::int32_t{2}), whole(static_cast<std::int32_t>(e.i)), whole(static_cast<std::int32_t>(e.j));
  }
  if (grid) {
    text += fmt::format("\nCELL_TYPES {}\n", count);
    for (std::size_t k = 0; k < count; ++k) whole(std::int32_t{3});
  }
  text += fmt::format("\nCELL_DATA {}\nSCALARS kind int 1\nLOOKUP_TABLE default\n", count);
  for (std::size_t k = 0; k < count; ++k) whole(std::int32_t{7});
  const std::size_t points = graph.points.size();
  text += fmt::format("\nPOINT_DATA {}", points) + unread_attributes(points, ascii);
  text += fmt::format("\nFIELD FieldData 2\nages 2 {} int\n", points);
  for (std::size_t k = 0; k < 2 * points; ++k) whole(std::int32_t{9});
  text += fmt::format("\nMETADATA\nINFORMATION 1\nNAME L\n\nradius 1 {} float\n", points);
  for (const Sphere& p : graph.points) real(p.radius);
  return text + "\nMETADATA\nINFORMATION 0\n\n";
}

RC_GTEST_PROP(VtkLegacyReader, ReadsWhatIsWritten, (bool ascii, bool version5, bool grid)) {
  const TestGraph graph = any_graph();
  is_the_graph(read_text("a.vtk", legacy_of(graph, ascii, version5, grid)), graph, 0, true, false);
}

const std::string start =
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 2 0 0 3 0 0\nLINES "
    "2 7\n3 0 1 2 2 1 3\n";

TEST(VtkLegacyReader, HalvesDiametersAndTakesTheLargestOfItsLines) {
  const auto of_points =
      read_text("a.vtk", start + "POINT_DATA 4\nFIELD f 1\nDIAMETER 1 4 double\n2 4 6 8\n");
  EXPECT_EQ(of_points.spheres[1].radius, 2.0f);
  const auto of_lines =
      read_text("a.vtk", start + "CELL_DATA 2\nSCALARS edge_radius float\nLOOKUP_TABLE default\n1 3\n");
  std::vector<float> radii;
  for (const Sphere& s : of_lines.spheres) radii.push_back(s.radius);
  EXPECT_EQ(radii, (std::vector<float>{1, 3, 1, 3}));
  EXPECT_EQ(of_lines.joints.size(), 1u);
  EXPECT_EQ(of_lines.warnings.size(), 1u);
  const auto diameters = read_text("a.vtk", start + "CELL_DATA 2\nFIELD f 1\ndiam 1 2 float\n1 3\n");
  EXPECT_EQ(diameters.spheres[1].radius, 1.5f);
  // Of points and lines both, the points' own.
  const std::string points = "POINT_DATA 4\nFIELD f 1\nr 1 4 float\n5 6 7 8\n",
                    lines = "CELL_DATA 2\nFIELD f 1\nr 1 2 float\n1 3\n";
  for (const std::string& both : {start + points + lines, start + lines + points}) {
    const CurveFile curves = read_text("a.vtk", both);
    EXPECT_EQ(curves.spheres[1].radius, 6.0f);
    ASSERT_EQ(curves.warnings.size(), 1u);
    EXPECT_EQ(curves.warnings[0], "'r' is of points, and of cells; the points' own are taken");
  }
}

// VTK has a cell type for one vertex and one for several, and a line may have one point only.
TEST(VtkLegacyReader, TakesSinglePointsForStrands) {
  const CurveFile curves =
      read_text("a.vtk",
                "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 7 float\n"
                "0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 0 0\nCELLS 5 12\n1 0\n2 1 2\n1 3\n2 4 5\n1 6\n"
                "CELL_TYPES 5\n1\n2\n4\n3\n5\n");
  EXPECT_EQ(curves.spheres,
            (std::vector<Sphere>{
                {4, 0, 0, 0}, {5, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {2, 0, 0, 0}, {3, 0, 0, 0}}));
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2, 3, 4, 5, 6}));
  EXPECT_EQ(curves.warnings, (std::vector<std::string>{"1 cell that is no line is left out",
                                                       "1 point that is of no line is left out"}));
}

TEST(VtkLegacyReader, CountsCellDataFromTheVertices) {
  const auto curves =
      read_text("a.vtk",
                "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 0 "
                "0\nVERTICES 1 2\n1 0\n"
                "LINES 1 3\n2 0 1\nPOLYGONS 1 3\n2 0 1\nCELL_DATA 3\nFIELD f 1\nradius 1 3 float\n7 5 9\n");
  EXPECT_EQ(curves.spheres[0].radius, 5.0f);
  EXPECT_EQ(curves.warnings.back(), "1 cell that is no line is left out");
}

// A vertex of a line is no strand of its own, and takes the radius of the line.
TEST(VtkReaders, TakeVerticesForStrandsOfOneSphere) {
  const auto
      legacy = read_text(
          "a.vtk",
          "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n0 0 0 1 0 0 2 0 0 "
          "3 0 0 4 0 0\nVERTICES 2 5\n2 3 0\n1 1\nLINES 1 3\n2 1 2\nCELL_DATA 3\nFIELD f 1\nradius "
          "1 3 float\n7 8 9\n"),
      xml = read_text(
          "a.vtp",
          "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfVerts=\"2\" NumberOfLines=\"1\"><Points>"
          "<DataArray type=\"Float32\">0 0 0 1 0 0 2 0 0 3 0 0 4 0 0</DataArray></Points>"
          "<Verts><DataArray Name=\"connectivity\">3 0 1</DataArray><DataArray Name=\"offsets\">2 "
          "3</DataArray></Verts>"
          "<Lines><DataArray Name=\"connectivity\">1 2</DataArray><DataArray "
          "Name=\"offsets\">2</DataArray></Lines>"
          "<CellData><DataArray Name=\"radius\">7 8 9</DataArray></CellData></Piece></PolyData></VTKFile>");
  for (const CurveFile* curves : {&legacy, &xml}) {
    EXPECT_EQ(curves->spheres, (std::vector<Sphere>{{1, 0, 0, 9}, {2, 0, 0, 9}, {0, 0, 0, 7}, {3, 0, 0, 7}}));
    EXPECT_EQ(curves->strand_first, (std::vector<std::uint32_t>{0, 2, 3, 4}));
    EXPECT_EQ(curves->warnings.back(), "1 point that is of no line is left out");
  }
}

TEST(VtkLegacyReader, RefusesOffsetsThatLeavePointsOver) {
  EXPECT_COMPLAINT("9: the offsets end at 2, not at 3, the numbers announced", "a.vtk",
                   "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 2 0 "
                   "0\nLINES 2 3\nOFFSETS "
                   "vtktypeint64\n0 2\nCONNECTIVITY vtktypeint64\n0 1 2\n");
}

TEST(VtkLegacyReader, RefusesCountsThatDoNotFit) {
  const auto file = [](const std::string& kind, const std::string& cells) {
    return "# vtk DataFile Version 5.1\nt\nASCII\nDATASET " + kind + "\nPOINTS 3 float\n0 0 0 1 0 0 2 0 0\n" +
           cells;
  };
  EXPECT_COMPLAINT("8: a cell of 2 points, where room for 1 is left", "a.vtk",
                   file("POLYDATA", "LINES 1 2\n2 0 1\n"));
  EXPECT_COMPLAINT("8: the cells take 3 numbers, not the 4 announced", "a.vtk",
                   file("POLYDATA", "LINES 1 4\n2 0 1\n"));
  EXPECT_COMPLAINT(
      "9: offset 1 is 9; offsets ascend from 0 to 3", "a.vtk",
      file("POLYDATA", "LINES 3 3\nOFFSETS vtktypeint64\n0 9 3\nCONNECTIVITY vtktypeint64\n0 1 2\n"));
  EXPECT_COMPLAINT("10: 1 cell, but 2 cell types", "a.vtk",
                   file("UNSTRUCTURED_GRID", "CELLS 1 3\n2 0 1\nCELL_TYPES 2\n3 3\n"));
}

// Carriage returns of another system are no part of a word.
TEST(VtkLegacyReader, ReadsLinesThatEndWithCrlf) {
  std::string crlf;
  for (const char c : start + "POINT_DATA 4\nFIELD f 1\nradius 1 4 float\n1 2 3 4\n")
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
  const CurveFile curves = read_text("a.vtk", crlf);
  EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{0, 0, 0, 1}, {1, 0, 0, 2}, {2, 0, 0, 3}, {3, 0, 0, 4}}));
}

TEST(VtkLegacyReader, AsksWhichArrayHoldsRadii) {
  const std::string two =
      start + "POINT_DATA 4\nFIELD f 2\nradius 1 4 float\n1 1 1 1\nmin_radius 1 4 float\n2 2 2 2\n";
  EXPECT_COMPLAINT(" the radii may be 'radius' or 'min_radius'; choose one with --array NAME", "a.vtk", two);
  const TestFile file("a.vtk", two);
  EXPECT_EQ(ReaderRegistry::instance().read(file.path(), {.array = "min_radius"}).spheres[0].radius, 2.0f);
  EXPECT_THROW(ReaderRegistry::instance().read(file.path(), {.array = "none"}), InputError);
  EXPECT_FALSE(read_text("a.vtk", start).has_radii);
}

TEST(VtkLegacyReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("1: the file does not start with '# vtk", "a.vtk", "VTK\nx\n");
  EXPECT_COMPLAINT("3: 'hex': expected ASCII or BINARY", "a.vtk", "# vtk DataFile Version 3.0\nt\nHEX\n");
  EXPECT_COMPLAINT("4: a dataset 'STRUCTURED_GRID' has no lines", "a.vtk",
                   "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n");
  EXPECT_COMPLAINT("8: a cell names point 4, of 4 from 0", "a.vtk",
                   start.substr(0, start.size() - 4) + "1 4\n");
  const std::string more = "METADATA\nINFORMATION 0\n\nPOINT_DATA 4\nFIELD f 1\nr 1 4 float\n1 1 1 1\n";
  EXPECT_COMPLAINT("8: a cell names point 4, of 4 from 0", "a.vtk",
                   start.substr(0, start.size() - 4) + "1 4\n" + more);
  EXPECT_COMPLAINT(
      " cell 1: a cell names point -1, of 2 from 0", "a.vtk",
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 float\n0 0 0 1 0 0\n"
      "CELLS 2 6\n2 0 1\n2 1 -1\nCELL_TYPES 2\n3 3\n");
  EXPECT_COMPLAINT("8: a cell of 9 points", "a.vtk", start.substr(0, start.find("3 0 1 2")) + "9 0 1\n");
  EXPECT_COMPLAINT(" 'radius' of point 1 is -1, no radius", "a.vtk",
                   start + "POINT_DATA 4\nFIELD f 1\nradius 1 4 float\n1 -1 1 1\n");
  EXPECT_COMPLAINT(" holds no lines, only 1 point and", "a.vtk",
                   "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n");
  EXPECT_COMPLAINT("9: 'wind': no section", "a.vtk", start + "WIND 3\n");
}

}  // namespace
}  // namespace catena
