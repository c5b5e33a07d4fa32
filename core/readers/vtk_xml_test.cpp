#include <fmt/format.h>
#include <zlib.h>

#include "catena/core/readers/test_bytes.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"
#include "catena/core/readers/vtk_xml_data.h"
#include "catena/reports/base64.h"

namespace catena {
namespace {

std::string base64_of(const std::string& bytes) { return reports::base64(std::span<const char>(bytes)); }

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  out.resize(size);
  return out;
}

/// How a VTK XML file is written.
struct Form {
  std::string format;  ///< ascii, binary, appended raw, appended base64
  bool compressed, big_endian, wide_header, grid;
};

class XmlWriter {
 public:
  explicit XmlWriter(const Form& form) : form_(form) {}

  template <class T>
  std::string array(const std::string& name, const std::string& type, int components,
                    const std::vector<T>& values) {
    std::string start =
        fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type, name, components);
    if (form_.format == "ascii") {
      start += " format=\"ascii\">";
      for (const T value : values) start += fmt::format("{} ", value);
      return start + "</DataArray>\n";
    }
    std::string bytes;
    for (const T value : values) append(bytes, value, form_.big_endian);
    const auto [header, data] = packed(bytes);
    if (form_.format == "binary") {
      const std::string text =
          form_.compressed ? base64_of(header) + base64_of(data) : base64_of(header + data);
      return start + " format=\"binary\">\n  " + text + "\n</DataArray>\n";
    }
    start += fmt::format(" format=\"appended\" offset=\"{}\"/>\n", appended_.size());
    if (form_.format == "appended raw")
      appended_ += header + data;
    else
      appended_ += form_.compressed ? base64_of(header) + base64_of(data) : base64_of(header + data);
    return start;
  }

  std::string file(const std::vector<TestGraph>& pieces) {
    const std::string type = form_.grid ? "UnstructuredGrid" : "PolyData";
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" "
        "header_type=\"{}\"{}>\n<{}>",
        type, form_.big_endian ? "BigEndian" : "LittleEndian", form_.wide_header ? "UInt64" : "UInt32",
        form_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "", type);
    for (const TestGraph& graph : pieces) text += piece(graph);
    text += "</" + type + ">\n";
    if (form_.format.starts_with("appended"))
      text +=
          "<AppendedData encoding=\"" + form_.format.substr(9) + "\">\n_" + appended_ + "\n</AppendedData>\n";
    return text + "</VTKFile>\n";
  }

 private:
  std::string piece(const TestGraph& graph) {
    std::vector<float> points, radii;
    std::vector<std::int64_t> ids, ends;
    std::vector<std::uint8_t> types;
    for (const Sphere& p : graph.points)
      points.insert(points.end(), {p.x, p.y, p.z}), radii.push_back(p.radius);
    for (const Pair& e : graph.edges) {
      ids.insert(ids.end(), {e.i, e.j});
      ends.push_back(static_cast<std::int64_t>(ids.size()));
      types.push_back(3);
    }
    const std::string cells = form_.grid ? "Cells" : "Lines";
    std::string text = fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\">\n",
                                   graph.points.size(), graph.edges.size());
    text += "<PointData>" + array("Radius", "Float32", 1, radii) + array("v", "Float32", 3, points) +
            "</PointData>\n";
    text += "<Points>" + array("Points", "Float32", 3, points) + "</Points>\n";
    text += "<" + cells + ">" + array("connectivity", "Int64", 1, ids) + array("offsets", "Int64", 1, ends);
    if (form_.grid) text += array("types", "UInt8", 1, types);
    return text + "</" + cells + ">\n</Piece>";
  }

  std::pair<std::string, std::string> packed(const std::string& bytes) {
    std::string header, data;
    const auto number = [&](std::uint64_t value) {
      form_.wide_header ? append(header, value, form_.big_endian)
                        : append(header, static_cast<std::uint32_t>(value), form_.big_endian);
    };
    if (!form_.compressed) {
      number(bytes.size());
      return {header, bytes};
    }
    const std::size_t block = 16, whole = bytes.size() / block, rest = bytes.size() % block;
    std::vector<std::string> blocks;
    for (std::size_t k = 0; k < whole + (rest > 0); ++k)
      blocks.push_back(deflated(bytes.substr(k * block, block)));
    number(blocks.size()), number(block), number(rest);
    for (const auto& b : blocks) number(b.size()), data += b;
    return {header, data};
  }

  Form form_;
  std::string appended_;
};

// Each piece numbers its own points from 0; points and arrays follow one another.
RC_GTEST_PROP(VtkXmlReader, ReadsWhatIsWritten,
              (bool compressed, bool big_endian, bool wide_header, bool grid)) {
  std::vector<TestGraph> pieces(*rc::gen::inRange<std::size_t>(1, 4));
  TestGraph all;
  for (TestGraph& piece : pieces) {
    piece = any_graph();
    const auto first = static_cast<std::uint32_t>(all.points.size());
    all.points.insert(all.points.end(), piece.points.begin(), piece.points.end());
    for (const Pair& edge : piece.edges) all.edges.push_back({first + edge.i, first + edge.j});
  }
  const Form form{
      *rc::gen::elementOf(std::vector<std::string>{"ascii", "binary", "appended raw", "appended base64"}),
      compressed, big_endian, wide_header, grid};
  is_the_graph(read_text(grid ? "a.vtu" : "a.vtp", XmlWriter(form).file(pieces)), all, 0, true, false);
}

TEST(VtkXmlReader, RefusesCountsThatDoNotFit) {
  const auto file = [](const char* points, const char* lines, const char* connectivity,
                       const char* components) {
    return fmt::format(
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\"><Points>"
        "<DataArray NumberOfComponents=\"{}\">0 0 0 1 0 0</DataArray></Points><Lines><DataArray "
        "Name=\"connectivity\">{}</DataArray><DataArray "
        "Name=\"offsets\">2</DataArray></Lines></Piece></PolyData></VTKFile>",
        points, lines, components, connectivity);
  };
  EXPECT_EQ(complaint("a.vtp", file("2", "1", "0 1", "3")), "");
  EXPECT_COMPLAINT(" NumberOfPoints is 3, but the piece has 2", "a.vtp", file("3", "1", "0 1", "3"));
  EXPECT_COMPLAINT(" NumberOfLines is 2, but the piece has 1", "a.vtp", file("2", "2", "0 1", "3"));
  EXPECT_COMPLAINT(" the offsets end at 2, the connectivity has 3 numbers", "a.vtp",
                   file("2", "1", "0 1 0", "3"));
  EXPECT_COMPLAINT(" points of '2' coordinates", "a.vtp", file("2", "1", "0 1", "2"));
  EXPECT_COMPLAINT(" NumberOfLines 'x' is no number", "a.vtp", file("2", "x", "0 1", "3"));
  EXPECT_COMPLAINT(" point number 0.5 is not one of 2 from 0", "a.vtp", file("2", "1", "0.5 1", "3"));
  EXPECT_COMPLAINT(" point number 2 is not one of 2 from 0", "a.vtp", file("2", "1", "0 2", "3"));
}

// A piece's cells name its own points, not those of a piece before it.
TEST(VtkXmlReader, RefusesWhatNoPieceHas) {
  const auto file = [](const std::string& second) {
    const std::string points = "<Points><DataArray>0 0 0 1 0 0</DataArray></Points>";
    return "<VTKFile type=\"PolyData\"><PolyData><Piece>" + points +
           "<Lines><DataArray Name=\"connectivity\">0 1</DataArray><DataArray "
           "Name=\"offsets\">2</DataArray></Lines></Piece><Piece NumberOfStrips=\"2\" NumberOfPolys=\"3\">" +
           points + second +
           "</Piece></PolyData><AppendedData encoding=\"raw\">_abcd</AppendedData></VTKFile>";
  };
  const auto lines = [&](const std::string& connectivity, const std::string& offsets) {
    return file("<Lines><DataArray Name=\"connectivity\">" + connectivity +
                "</DataArray><DataArray Name=\"offsets\">" + offsets + "</DataArray></Lines>");
  };
  const CurveFile good = read_text("a.vtp", lines("1 0", "2"));
  EXPECT_EQ(good.spheres.size(), 4u);
  EXPECT_EQ(good.warnings, std::vector<std::string>{"5 cells that are no lines are left out"});
  EXPECT_COMPLAINT(" point number 2 is not one of 2 from 0", "a.vtp", lines("0 2", "2"));
  EXPECT_COMPLAINT(" offset 1 is below the one before it", "a.vtp", lines("0 1", "2 1"));
  EXPECT_COMPLAINT(" offset 3 is not one of 3 from 0", "a.vtp", lines("0 1", "3"));
  const auto radii = [&](const std::string& attributes) {
    return file("<PointData><DataArray Name=\"radius\" " + attributes + "/></PointData>");
  };
  EXPECT_COMPLAINT(" 'radius': the offset is not in the appended data", "a.vtp",
                   radii("type=\"Float32\" format=\"appended\" offset=\"5\""));
  EXPECT_COMPLAINT(" 'radius': its data is cut off", "a.vtp",
                   radii("type=\"Float32\" format=\"appended\" offset=\"4\""));
  for (const std::string type : {"Float16", "Float8", "Int128", "String"})
    EXPECT_COMPLAINT(" 'radius': the type '" + type + "' is not known", "a.vtp",
                     file("<PointData><DataArray Name=\"radius\" format=\"binary\" type=\"" + type +
                          "\">AAAAAA==</DataArray></PointData>"));
}

// What a header announces is not believed: no memory is asked for, and no other bytes are taken for the data.
TEST(VtkXmlReader, HoldsCompressedDataAgainstItsHeader) {
  const auto bytes_of = [](std::uint64_t blocks, std::uint64_t block, std::uint64_t last) {
    const std::string data = deflated("abcdefgh");
    std::string bytes;
    for (const std::uint64_t number : {blocks, block, last, std::uint64_t{data.size()}})
      append(bytes, number, false);
    return vtk_xml_bytes(bytes + data, false, {.header_size = 8, .compressed = true});
  };
  EXPECT_EQ(bytes_of(1, 8, 0), "abcdefgh");  // 0: the last block is whole
  EXPECT_EQ(bytes_of(1, 9, 8), "abcdefgh");
  EXPECT_EQ(bytes_of(0, 8, 0), "");
  for (const std::uint64_t wrong : {7, 9}) {
    EXPECT_THROW(bytes_of(1, wrong, 0), InputError);
    EXPECT_THROW(bytes_of(1, 8, wrong), InputError);
  }
  for (const std::uint64_t many : {std::uint64_t{2}, std::uint64_t{1} << 59, ~std::uint64_t{0}})
    EXPECT_THROW(bytes_of(many, 8, 0), InputError);
}

TEST(VtkXmlReader, ComplainsInOneLine) {
  EXPECT_COMPLAINT(" byte ", "a.vtp", "<VTKFile");
  EXPECT_COMPLAINT(" is XML, but no VTKFile", "a.vtp", "<a/>");
  EXPECT_COMPLAINT(" holds 'ImageData'", "a.vtp", "<VTKFile type=\"ImageData\"/>");
  EXPECT_COMPLAINT(" its data is compressed by 'vtkLZ4DataCompressor'", "a.vtp",
                   "<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"/>");
  EXPECT_COMPLAINT(" 'array': its data is cut off", "a.vtp",
                   "<VTKFile type=\"PolyData\"><PolyData><Piece><Points><DataArray type=\"Float32\" "
                   "format=\"binary\">AAAB</DataArray></Points></Piece></PolyData></VTKFile>");
}

}  // namespace
}  // namespace catena
