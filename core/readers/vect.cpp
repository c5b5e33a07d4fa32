#include <fmt/format.h>

#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Geomview VECT: `VECT`, the numbers of polylines, vertices and colours, the vertex count of each polyline
/// (negative: closed), the colour count of each, the vertices, the colours. Free form: line ends mean nothing
/// but the end of a comment. No radii.
namespace catena {
namespace {

class Vect {
 public:
  Vect(const std::filesystem::path& file, const ReadOptions& options) : lines_(file), curves_(options) {}

  CurveFile curves() {
    lines_.read_once();
    if (token("the keyword VECT") != "VECT")
      lines_.fail("a VECT file starts with the keyword VECT (4VECT and binary VECT are not supported)");
    const std::uint32_t polylines = limited_count("number of polylines");
    const std::uint32_t vertices = limited_count("number of vertices");
    const std::uint32_t colours = limited_count("number of colours");

    std::vector<std::int64_t> signed_count(polylines);
    std::uint64_t all_vertices = 0, all_colours = 0;
    for (auto& count : signed_count) {
      count = lines_.integer(token("a vertex count"), "vertex count");
      if (magnitude(count) > vertices)
        lines_.fail(fmt::format("vertex count {} exceeds the total of {}", count, vertices));
      all_vertices += magnitude(count);
    }
    if (all_vertices != vertices)
      lines_.fail(fmt::format("the vertex counts of the polylines sum to {}, the header says {}",
                              all_vertices, vertices));
    for (std::uint32_t i = 0; i < polylines; ++i)
      all_colours += lines_.count(token("a colour count"), "colour count");
    if (all_colours != colours)
      lines_.fail(fmt::format("the colour counts of the polylines sum to {}, the header says {}", all_colours,
                              colours));

    curves_.spheres.reserve(vertices);
    for (const std::int64_t count : signed_count) {
      for (std::uint64_t i = 0; i < magnitude(count); ++i) add_vertex();
      curves_.end_strand(count < 0);
    }
    for (std::uint64_t i = 0; i < std::uint64_t{colours} * 4; ++i) lines_.real(token("a colour"), "colour");
    if (has_more())
      lines_.fail(fmt::format("{} stands after all that the header declares, vertices: {}, colours: {}",
                              in_quotes(row_[at_]), vertices, colours));
    return std::move(curves_);
  }

 private:
  static std::uint64_t magnitude(std::int64_t count) {
    return count < 0 ? 0 - static_cast<std::uint64_t>(count) : static_cast<std::uint64_t>(count);
  }

  // Anything that is counted takes at least two characters, so a larger number than the file's size is wrong,
  // and is found out before memory is asked for.
  std::uint32_t limited_count(const std::string& what) {
    const std::uint32_t count = lines_.count(token("the " + what), what);
    if (count > lines_.bytes())
      lines_.fail(fmt::format("{} {} is more than a file of {} bytes can hold", what, count, lines_.bytes()));
    return count;
  }

  void add_vertex() {
    const double x = lines_.coordinate(token("a vertex"), "x");
    const double y = lines_.coordinate(token("a vertex"), "y");
    const double z = lines_.coordinate(token("a vertex"), "z");
    curves_.add_point(x, y, z);
  }

  bool has_more() {
    while (at_ == row_.size()) {
      if (!lines_.next()) return false;
      lines_.cut_comment('#');
      row_ = lines_.fields();
      at_ = 0;
    }
    return true;
  }

  std::string_view token(const std::string& wanted) {
    if (!has_more()) lines_.fail(fmt::format("the file is truncated: it ends where {} is due", wanted));
    return row_[at_++];
  }

  TextLines lines_;
  std::vector<std::string_view> row_;
  std::size_t at_ = 0;
  CurveFile curves_;
};

const RegisterReader registered{
    {"Geomview VECT", {".vect"}, "polylines, open or closed; no radii", "vertex number from 0"},
    read_by<Vect>};

}  // namespace
}  // namespace catena
