#include <fmt/format.h>

#ifdef CATENA_HAS_PUGIXML
#include <pugixml.hpp>
#endif

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"
#include "catena/core/readers/vtk_mesh.h"
#include "catena/core/readers/vtk_xml_data.h"

/// VTK's XML files, https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html: PolyData and
/// UnstructuredGrid of any number of pieces; arrays as text, base64 or appended, raw or base64, plain or
/// compressed by zlib. What is taken of them vtk_mesh.h says.
namespace catena {
namespace {

#ifdef CATENA_HAS_PUGIXML

/// The file's text without what is appended, which need not be XML, and where that begins.
struct Parts {
  std::string bytes;
  std::string xml;            ///< used when something is appended; `bytes` is all XML otherwise
  std::string_view appended;  ///< behind the underscore
};

Parts parted(std::string bytes) {
  Parts parts{std::move(bytes), "", ""};
  const std::size_t element = parts.bytes.find("<AppendedData");
  if (element == std::string::npos) return parts;
  const std::size_t begin =
      parts.bytes.find('_', std::min(parts.bytes.find('>', element), parts.bytes.size()));
  if (begin == std::string::npos) return parts;
  const std::size_t end =
      std::max(begin + 1, std::min(parts.bytes.rfind("</AppendedData"), parts.bytes.size()));
  parts.appended = std::string_view(parts.bytes).substr(begin + 1, end - begin - 1);
  parts.xml = parts.bytes.substr(0, begin) + "</AppendedData></VTKFile>";
  return parts;
}

class VtkXml {
 public:
  VtkXml(const std::filesystem::path& file, const ReadOptions& options)
      : name_(shown_name(file)), parts_(parted(read_bytes(file))), mesh_(options) {
    std::string& text = parts_.xml.empty() ? parts_.bytes : parts_.xml;
    const auto parsed = document_.load_buffer_inplace(text.data(), text.size());
    if (!parsed) fail(fmt::format("byte {}: {}", parsed.offset, parsed.description()));
  }

  CurveFile curves() {
    const pugi::xml_node root = document_.child("VTKFile");
    if (!root) fail("is XML, but no VTKFile");
    read_form(root);
    const std::string type = root.attribute("type").value();
    const pugi::xml_node data = root.child(type.c_str());
    if (type != "PolyData" && type != "UnstructuredGrid")
      fail(fmt::format("holds {}; poly-lines are in PolyData and UnstructuredGrid", in_quotes(type)));
    appended_base64_ = std::string_view(root.child("AppendedData").attribute("encoding").value()) == "base64";
    for (const pugi::xml_node piece : data.children("Piece"))
      type == "PolyData" ? read_lines(piece) : read_grid(piece);
    document_.reset();
    std::exchange(parts_.bytes, {});  // an assignment would keep the memory
    return mesh_.curves(name_);
  }

 private:
  void read_form(const pugi::xml_node& root) {
    form_.big_endian = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
    const std::string_view header = root.attribute("header_type").as_string("UInt32");
    if (header != "UInt32" && header != "UInt64")
      fail(fmt::format("the header_type {} is not known", in_quotes(header)));
    form_.header_size = header == "UInt64" ? 8 : 4;
    const std::string_view compressor = root.attribute("compressor").value();
    form_.compressed = !compressor.empty();
    if (form_.compressed && compressor != "vtkZLibDataCompressor")
      fail(fmt::format("its data is compressed by {}; write it with ZLib or none", in_quotes(compressor)));
  }

  void read_points(const pugi::xml_node& piece) {
    first_point_ = mesh_.points();
    const auto array = piece.child("Points").child("DataArray");
    const std::string_view components = array.attribute("NumberOfComponents").as_string("3");
    if (components != "3")
      fail(fmt::format("points of {} coordinates; three are due", in_quotes(components)));
    const std::vector<double> values = array ? numbers(array) : std::vector<double>{};
    if (values.size() % 3 != 0) fail(fmt::format("{} coordinates are no points of three", values.size()));
    require_count(piece, "NumberOfPoints", values.size() / 3);
    mesh_.reserve_points(mesh_.points() + values.size() / 3);
    for (std::size_t k = 0; k < values.size(); k += 3) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!std::isfinite(static_cast<float>(values[k + axis])))
          fail(fmt::format("{} of point {} is {}, no finite 32-bit float", "xyz"[axis], k / 3,
                           values[k + axis]));
      mesh_.add_point(values[k], values[k + 1], values[k + 2]);
    }
  }

  // Cell data counts vertices first, then lines, then the rest.
  void read_lines(const pugi::xml_node& piece) {
    read_points(piece);
    read_cells(piece.child("Verts"), [](std::size_t) { return VtkMesh::poly_vertex; },
               {piece, "NumberOfVerts"});
    read_cells(piece.child("Lines"), [](std::size_t) { return VtkMesh::poly_line; },
               {piece, "NumberOfLines"});
    mesh_.add_other_cells(cells_of(piece, "NumberOfStrips") + cells_of(piece, "NumberOfPolys"));
    read_arrays(piece);
  }

  void read_grid(const pugi::xml_node& piece) {
    read_points(piece);
    const auto types = numbers_named(piece.child("Cells"), "types"),
               ends = numbers_named(piece.child("Cells"), "offsets");
    if (types.size() != ends.size())
      fail(fmt::format("{}, but {}", counted(ends.size(), "cell"), counted(types.size(), "cell type")));
    read_cells(piece.child("Cells"), [&](std::size_t k) { return index(types[k], 256, "cell type"); },
               {piece, "NumberOfCells"});
    read_arrays(piece);
  }

  /// An attribute that a file may leave out.
  void require_count(const pugi::xml_node& piece, const char* attribute, std::uint64_t found) const {
    if (piece.attribute(attribute) && cells_of(piece, attribute) != found)
      fail(fmt::format("{} is {}, but the piece has {}", attribute, piece.attribute(attribute).value(),
                       found));
  }

  std::uint64_t cells_of(const pugi::xml_node& piece, const char* attribute) const {
    const auto [value, problem] = parse_integer(piece.attribute(attribute).as_string("0"));
    if (!problem.empty() || value < 0 || value > 0xFFFFFFFF)
      fail(fmt::format("{} {} is no number that a file can have", attribute,
                       in_quotes(piece.attribute(attribute).value())));
    return static_cast<std::uint64_t>(value);
  }

  struct Announced {
    const pugi::xml_node& piece;
    const char* attribute;
  };

  /// type(k): VTK's number for what cell k is.
  template <class Type>
  void read_cells(const pugi::xml_node& cells, const Type& type, const Announced& announced) {
    const auto points = numbers_named(cells, "connectivity"), ends = numbers_named(cells, "offsets");
    require_count(announced.piece, announced.attribute, ends.size());
    std::vector<std::int64_t> line;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const auto end = static_cast<std::size_t>(index(ends[k], points.size() + 1, "offset"));
      if (end < begin) fail(fmt::format("offset {} is below the one before it", ends[k]));
      line.clear();
      for (; begin < end; ++begin)
        line.push_back(first_point_ + index(points[begin], mesh_.points() - first_point_, "point number"));
      if (const std::string problem = mesh_.add_cell(type(k), line); !problem.empty()) fail(problem);
    }
    if (begin != points.size())
      fail(fmt::format("the offsets end at {}, the connectivity has {}", begin,
                       counted(points.size(), "number")));
  }

  /// One of `many` from 0.
  std::int64_t index(double value, std::uint64_t many, std::string_view what) const {
    if (!(value >= 0 && value < static_cast<double>(many)) || value != std::floor(value))
      fail(fmt::format("{} {} is not one of {} from 0", what, value, many));
    return static_cast<std::int64_t>(value);
  }

  void read_arrays(const pugi::xml_node& piece) {
    for (const auto of : {VtkMesh::Of::points, VtkMesh::Of::cells})
      for (const pugi::xml_node array :
           piece.child(of == VtkMesh::Of::points ? "PointData" : "CellData").children("DataArray")) {
        const std::string_view name = array.attribute("Name").value();
        if (std::string_view(array.attribute("NumberOfComponents").as_string("1")) == "1" &&
            mesh_.may_be_radii(name))
          mesh_.add_array(name, of, numbers(array));
      }
  }

  std::vector<double> numbers_named(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node array = parent.find_child_by_attribute("DataArray", "Name", name);
    return array ? numbers(array) : std::vector<double>{};
  }

  std::vector<double> numbers(const pugi::xml_node& array) const {
    const std::string_view format = array.attribute("format").as_string("ascii");
    const std::string_view name = array.attribute("Name").as_string("array");
    if (format == "ascii") return numbers_of_text(array.child_value(), name);
    if (format != "binary" && format != "appended")
      fail(fmt::format("{}: the format {} is not known", in_quotes(name), in_quotes(format)));
    std::string_view data = array.child_value();
    if (format == "appended") {
      const auto [offset, problem] = parse_integer(array.attribute("offset").value());
      if (!problem.empty() || offset < 0 || static_cast<std::uint64_t>(offset) > parts_.appended.size())
        fail(fmt::format("{}: the offset is not in the appended data", in_quotes(name)));
      data = parts_.appended.substr(static_cast<std::size_t>(offset));
    }
    try {
      return numbers_of_bytes(vtk_xml_bytes(data, format == "binary" || appended_base64_, form_),
                              array.attribute("type").value());
    } catch (const InputError& error) {
      fail(fmt::format("{}: {}", in_quotes(name), error.what()));
    }
  }

  std::vector<double> numbers_of_text(std::string_view text, std::string_view name) const {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    std::vector<double> numbers;
    for (std::size_t at = 0; (at = text.find_first_not_of(blanks, at)) != std::string_view::npos;) {
      const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
      const auto [value, problem] = parse_coordinate(text.substr(at, end - at));
      if (!problem.empty())
        fail(fmt::format("{}: {} {}", in_quotes(name), in_quotes(text.substr(at, end - at)), problem));
      numbers.push_back(value);
      at = end;
    }
    return numbers;
  }

  std::vector<double> numbers_of_bytes(std::string_view bytes, std::string_view type) const {
    const bool floating = type.starts_with("Float"), is_signed = type.starts_with("Int");
    const std::string_view bits_text = type.substr(std::min(type.find_first_of("1368"), type.size()));
    const std::size_t size = bits_text == "8"    ? 1
                             : bits_text == "16" ? 2
                             : bits_text == "32" ? 4
                             : bits_text == "64" ? 8
                                                 : 0;
    if (size == 0 || (!floating && !is_signed && !type.starts_with("UInt")) || (floating && size < 4))
      throw InputError(fmt::format("the type {} is not known", in_quotes(type)));
    if (bytes.size() % size != 0)
      throw InputError(fmt::format("{} cannot be numbers of {}", counted(bytes.size(), "byte"), size));
    std::vector<double> numbers;
    numbers.reserve(bytes.size() / size);
    for (std::size_t at = 0; at < bytes.size(); at += size) {
      const std::uint64_t bits = vtk_xml_number(bytes.substr(at, size), form_.big_endian);
      const auto unused = static_cast<unsigned>(64 - 8 * size);
      numbers.push_back(floating ? (size == 4 ? double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))}
                                              : std::bit_cast<double>(bits))
                        : is_signed ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused)
                                    : static_cast<double>(bits));
    }
    return numbers;
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(fmt::format("{}: {}", name_, reason));
  }

  std::string name_;
  Parts parts_;
  pugi::xml_document document_;
  VtkXmlForm form_;
  bool appended_base64_ = false;
  VtkMesh mesh_;
  std::int64_t first_point_ = 0;  ///< of the piece
};

#else

class VtkXml {
 public:
  VtkXml(const std::filesystem::path& file, const ReadOptions&) {
    throw InputError(
        fmt::format("{}: this catena was built without an XML library; build with libpugixml-dev, or write "
                    "a legacy .vtk file",
                    shown_name(file)));
  }
  CurveFile curves() { return {}; }
};

#endif

const RegisterReader registered{{"VTK XML",
                                 {".vtp", ".vtu"},
                                 "poly-lines with radii, as .vtk; text, base64 or appended, plain or zlib's",
                                 "point number from 0",
                                 {"--array"}},
                                read_by<VtkXml>};

}  // namespace
}  // namespace catena
