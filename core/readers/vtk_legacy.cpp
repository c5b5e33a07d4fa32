#include <fmt/format.h>

#include <optional>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"
#include "catena/core/readers/vtk_mesh.h"
#include "catena/core/readers/vtk_numbers.h"

/// VTK's legacy files, https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html: POLYDATA
/// and UNSTRUCTURED_GRID, ASCII and binary (big-endian), of versions 1 to 5. What is taken of them vtk_mesh.h
/// says.
namespace catena {
namespace {

using Kind = VtkNumbers::Kind;
using Type = VtkNumbers::Type;

/// VTK writes a name's odd characters as %20.
std::string decoded(std::string_view name) {
  std::string plain;
  for (std::size_t k = 0; k < name.size(); ++k) {
    const auto digit = [&](std::size_t at) { return std::string_view("0123456789ABCDEF").find(name[at]); };
    if (name[k] == '%' && k + 2 < name.size() && digit(k + 1) != std::string::npos &&
        digit(k + 2) != std::string::npos) {
      plain += static_cast<char>(digit(k + 1) * 16 + digit(k + 2));
      k += 2;
    } else {
      plain += name[k];
    }
  }
  return plain;
}

class VtkLegacy {
 public:
  VtkLegacy(const std::filesystem::path& file, const ReadOptions& options)
      : numbers_(file), fields_(numbers_.fields()), mesh_(options) {}

  CurveFile curves() {
    if (!fields_.line("the header").starts_with("# vtk DataFile Version"))
      fail("the file does not start with '# vtk DataFile Version'");
    fields_.line("the title");
    const std::string form = lower_case(trimmed(fields_.line("ASCII or BINARY")));
    if (form != "ascii" && form != "binary")
      fail(fmt::format("{}: expected ASCII or BINARY", in_quotes(form)));
    numbers_.are_ascii(form == "ascii");
    while (!fields_.next_word().empty()) read_section();
    add_cells();
    fields_.forget();
    return mesh_.curves(fields_.file_name());
  }

 private:
  struct Cells {
    std::vector<std::int64_t> points;
    std::vector<std::uint64_t> end;
  };

  void read_section() {
    const std::string word = lower_case(fields_.next_word());
    if (word == "metadata") return skip_metadata();
    words_of_line();
    if (word == "dataset") return check_dataset();
    if (word == "points") return read_points();
    if (word == "vertices") return read_cells(vertices_);
    if (word == "lines" || word == "cells") return read_cells(lines_);
    if (word == "polygons" || word == "triangle_strips") return read_cells(others_);
    if (word == "cell_types") return read_types();
    if (word == "point_data" || word == "cell_data") {
      of_ = word == "point_data" ? VtkMesh::Of::points : VtkMesh::Of::cells;
      items_ = count(1, "number of items");
      return;
    }
    if (word == "field") return read_field();
    read_attribute(word);
  }

  void check_dataset() {
    const std::string kind = lower_case(argument(1));
    unstructured_ = kind == "unstructured_grid";
    if (!unstructured_ && kind != "polydata")
      fail(fmt::format("a dataset {} has no lines; poly-lines are in POLYDATA and UNSTRUCTURED_GRID",
                       in_quotes(argument(1))));
  }

  void read_points() {
    const std::uint64_t points = count(1, "number of points");
    const Type type = numbers_.type_of(argument(2));
    numbers_.require(points, 3, type);
    mesh_.reserve_points(points);
    for (std::uint64_t p = 0; p < points; ++p) {
      const double x = numbers_.coordinate(type, "x"), y = numbers_.coordinate(type, "y"),
                   z = numbers_.coordinate(type, "z");
      mesh_.add_point(x, y, z);
    }
  }

  void read_cells(Cells& cells) {
    const std::uint64_t first = count(1, "number of cells"), second = count(2, "size of the cells");
    if (lower_case(fields_.next_word()) == "offsets") return read_offset_cells(cells, first, second);
    numbers_.require(second, 1, VtkNumbers::int32);
    std::uint64_t used = 0;
    for (std::uint64_t cell = 0; cell < first; ++cell) {
      if (used >= second)
        fail(fmt::format("{} do not fit into the {} announced", counted(first, "cell"),
                         counted(second, "number")));
      const std::int64_t size = numbers_.integer(VtkNumbers::int32, "size of a cell");
      if (size < 0) fail(fmt::format("a cell of {} points", size));
      if (static_cast<std::uint64_t>(size) > second - used - 1)
        fail(fmt::format("a cell of {}, where room for {} is left",
                         counted(static_cast<std::uint64_t>(size), "point"), second - used - 1));
      for (std::int64_t k = 0; k < size; ++k) cells.points.push_back(point_of(cells, VtkNumbers::int32));
      cells.end.push_back(cells.points.size());
      used += 1 + static_cast<std::uint64_t>(size);
    }
    if (used != second)
      fail(fmt::format("the cells take {}, not the {} announced", counted(used, "number"), second));
  }

  // Version 5: where each cell begins, and one more; then the points.
  void read_offset_cells(Cells& cells, std::uint64_t offsets, std::uint64_t size) {
    words_of_line();
    const Type type = numbers_.type_of(argument(1));
    numbers_.require(offsets, 1, type);
    std::vector<std::int64_t> begin(offsets);
    for (auto& offset : begin) offset = numbers_.integer(type, "offset");
    for (std::size_t k = 0; k < begin.size(); ++k)
      if (k == 0 ? begin[k] != 0 : begin[k] < begin[k - 1] || static_cast<std::uint64_t>(begin[k]) > size)
        fail(fmt::format("offset {} is {}; offsets ascend from 0 to {}", k, begin[k], size));
    if (const std::int64_t last = begin.empty() ? 0 : begin.back(); static_cast<std::uint64_t>(last) != size)
      fail(fmt::format("the offsets end at {}, not at {}, the numbers announced", last, size));
    words_of_line();
    if (lower_case(argument(0)) != "connectivity") fail("CONNECTIVITY is due after OFFSETS");
    const Type point_type = numbers_.type_of(argument(1));
    numbers_.require(size, 1, point_type);
    for (std::uint64_t k = 0; k < size; ++k) cells.points.push_back(point_of(cells, point_type));
    for (std::size_t k = 1; k < begin.size(); ++k) cells.end.push_back(static_cast<std::uint64_t>(begin[k]));
  }

  // What is no point is said where it stands. Not of a grid: which of its cells name points its types tell,
  // which follow.
  std::int64_t point_of(const Cells& cells, Type type) {
    const std::int64_t point = numbers_.integer(type, "point number");
    const bool known = !unstructured_ && &cells != &others_ && mesh_.points() > 0;
    if (const std::string refusal = known ? mesh_.refusal_of(point) : ""; !refusal.empty()) fail(refusal);
    return point;
  }

  void read_types() {
    const std::uint64_t cells = count(1, "number of cell types");
    numbers_.require(cells, 1, VtkNumbers::int32);
    for (std::uint64_t k = 0; k < cells; ++k)
      types_.push_back(numbers_.integer(VtkNumbers::int32, "cell type"));
  }

  // Cell data counts vertices first, then lines, then the rest.
  void add_cells() {
    if (unstructured_ && types_.size() != lines_.end.size())
      fail(
          fmt::format("{}, but {}", counted(lines_.end.size(), "cell"), counted(types_.size(), "cell type")));
    const auto add = [&](Cells& cells, const auto& type_of_cell) {
      std::uint64_t begin = 0;
      for (std::size_t k = 0; k < cells.end.size(); ++k) {
        const auto points = std::span(cells.points).subspan(begin, cells.end[k] - begin);
        begin = cells.end[k];
        if (const std::string problem = mesh_.add_cell(type_of_cell(k), points); !problem.empty())
          throw InputError(fmt::format("{}: cell {}: {}", fields_.file_name(), k, problem));
      }
      std::exchange(cells, {});
    };
    add(vertices_, [](std::size_t) { return VtkMesh::poly_vertex; });
    add(lines_, [&](std::size_t k) { return unstructured_ ? types_[k] : VtkMesh::poly_line; });
    mesh_.add_other_cells(others_.end.size());
  }

  void read_field() {
    const std::uint64_t arrays = count(2, "number of arrays");
    for (std::uint64_t k = 0; k < arrays; ++k) {
      while (lower_case(fields_.next_word()) == "metadata") skip_metadata();
      words_of_line();
      read_array(argument(0), count(1, "number of components"), count(2, "number of tuples"),
                 numbers_.type_of(argument(3)));
    }
  }

  void read_attribute(const std::string& word) {
    const std::string name = words_.size() > 1 ? words_[1] : "";
    if (word == "scalars") {
      const Type type = numbers_.type_of(argument(2));
      const std::uint64_t components = words_.size() > 3 ? count(3, "number of components") : 1;
      if (lower_case(fields_.next_word()) == "lookup_table") words_of_line();
      read_array(name, components, items_, type);
    } else if (word == "vectors" || word == "normals") {
      read_array(name, 3, items_, numbers_.type_of(argument(2)));
    } else if (word == "tensors" || word == "tensors6") {
      read_array(name, word == "tensors" ? 9 : 6, items_, numbers_.type_of(argument(2)));
    } else if (word == "texture_coordinates") {
      read_array(name, count(2, "dimension"), items_, numbers_.type_of(argument(3)));
    } else if (word == "global_ids" || word == "pedigree_ids" || word == "edge_flags") {
      read_array(name, 1, items_, numbers_.type_of(argument(2)));
    } else if (word == "color_scalars") {
      read_array(name, count(2, "number of components"), items_, colour_type());
    } else if (word == "lookup_table") {
      read_array("", 4, count(2, "size of the table"), colour_type());
    } else {
      fail(fmt::format("{}: no section of a VTK file is named so", in_quotes(word)));
    }
  }

  void read_array(const std::string& coded_name, std::uint64_t components, std::uint64_t tuples, Type type) {
    if (components > 0 && tuples > fields_.size() / components)
      fail("more numbers are announced than the file can hold");
    numbers_.require(tuples, components, type);
    const std::string name = decoded(coded_name);
    if (of_ && components == 1 && mesh_.may_be_radii(name)) {
      std::vector<double> values(tuples);
      for (double& value : values) value = numbers_.real(type, name);
      mesh_.add_array(name, *of_, values);
    } else {
      numbers_.skip(tuples * components, type, name);
    }
  }

  // Up to a blank line, or the file's end.
  void skip_metadata() {
    fields_.word("METADATA");
    fields_.line("METADATA");
    while (!fields_.next_word().empty() && !trimmed(fields_.line("METADATA")).empty()) {
    }
  }

  void words_of_line() {
    const std::string_view first = fields_.word("a section");
    words_.assign(1, std::string(first));
    std::string_view rest = fields_.left() > 0 ? fields_.line("a section") : "";
    while (!(rest = trimmed(rest)).empty()) {
      const std::size_t end = std::min(rest.find_first_of(" \t\v\f"), rest.size());
      words_.emplace_back(rest.substr(0, end));
      rest.remove_prefix(end);
    }
  }

  const std::string& argument(std::size_t k) const {
    if (k >= words_.size()) fail(fmt::format("{}: word {} is missing after it", in_quotes(words_[0]), k));
    return words_[k];
  }

  std::uint64_t count(std::size_t k, std::string_view what) const {
    return numbers_.count(argument(k), what);
  }
  Type colour_type() const {
    return numbers_.ascii() ? Type{4, Kind::floating} : Type{1, Kind::unsigned_integer};
  }
  [[noreturn]] void fail(const std::string& reason) const { numbers_.fail(reason); }

  VtkNumbers numbers_;
  BinaryFields& fields_;  ///< of the numbers
  VtkMesh mesh_;
  bool unstructured_ = false;
  std::vector<std::string> words_;  ///< of the section's line
  std::optional<VtkMesh::Of> of_;
  std::uint64_t items_ = 0;
  Cells vertices_, lines_, others_;
  std::vector<std::int64_t> types_;
};

const RegisterReader registered{
    {"VTK legacy",
     {".vtk"},
     "poly-lines with radii, ASCII or binary; lines that share points are branches",
     "point number from 0",
     {"--array"}},
    read_by<VtkLegacy>};

}  // namespace
}  // namespace catena
