#include <fmt/format.h>

#include "catena/core/counted.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Four numbers a line, `x y z r`, separated by blanks or commas, as MSMS and VMTK's tables have them. `#`
/// starts a comment; a blank line ends a strand.
namespace catena {
namespace {

class Xyzr {
 public:
  Xyzr(const std::filesystem::path& file, const ReadOptions& options) : lines_(file), curves_(options) {}

  CurveFile curves() {
    curves_.has_radii = true;
    lines_.read_once();
    while (lines_.next()) {
      if (trimmed(lines_.line()).empty()) curves_.end_strand();
      lines_.cut_comment('#');
      if (!lines_.line().empty()) read_point();
    }
    curves_.end_strand();
    return std::move(curves_);
  }

 private:
  void read_point() {
    const auto& fields = lines_.columns();
    if (fields.size() != 4)
      lines_.fail(fmt::format("a point is 'x y z r', got {}", counted(fields.size(), "column")));
    curves_.add_point(lines_.coordinate(fields[0], "x"), lines_.coordinate(fields[1], "y"),
                      lines_.coordinate(fields[2], "z"), lines_.radius(fields[3]));
    curves_.labels.add(static_cast<std::int64_t>(lines_.line_number()));
  }

  TextLines lines_;
  CurveFile curves_;
};

const RegisterReader registered{
    {"xyzr columns", {".xyzr"}, "x y z r in columns; a blank line ends a strand", "line"}, read_by<Xyzr>};

}  // namespace
}  // namespace catena
