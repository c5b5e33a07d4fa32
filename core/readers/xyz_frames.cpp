#include "catena/core/readers/xyz_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/readers/extended_xyz.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/row_columns.h"
#include "catena/core/readers/table_points.h"

namespace catena {
namespace {

class XyzFrames {
 public:
  XyzFrames(TextLines& lines, const ReadOptions& options, CurveFile& curves)
      : lines_(lines), options_(options), curves_(curves), points_(lines, curves) {}

  void read() {
    for (bool first = true; lines_.next_content(); first = false) {
      if (!first) curves_.begin_later_frame();
      read_frame(first);
    }
    points_.finish();
  }

 private:
  void read_frame(bool first) {
    const auto& head = lines_.fields();
    if (head.size() != 1 || !is_integer(head[0]))
      lines_.fail(fmt::format("the number of points of another frame is due here, or the end: {} announced",
                              announced_ == 1 ? "1 point was" : fmt::format("{} points were", announced_)));
    announced_ = lines_.count(head[0], "number of points");
    if (!first && announced_ != curves_.spheres.size())
      lines_.fail(fmt::format("frame {} has {}, frame 0 has {}", curves_.later_frames.size(),
                              counted(announced_, "point"), curves_.spheres.size()));
    const std::size_t count_line = lines_.line_number();
    if (first) curves_.spheres.reserve(std::min<std::size_t>(announced_, lines_.bytes() / 6));
    ExtendedXyz title;
    if (has_title()) title = read_title(first);
    take_box(title, first);
    for (std::uint32_t i = 0; i < announced_; ++i) {
      if (!lines_.next_content() || is_count())
        lines_.fail_at(count_line, fmt::format("{} point{} announced, {} follow", announced_,
                                               announced_ == 1 ? " is" : "s are", i));
      const auto& row = lines_.columns();
      if (i == 0) choose_columns(title, row, first);
      points_.add(row);
    }
  }

  bool is_count() {
    const auto& fields = lines_.fields();
    return fields.size() == 1 && is_integer(fields[0]);
  }

  // The format has a title, so any line is one; but some writers leave it out, and then a line is missing.
  bool has_title() {
    if (announced_ == 0) return true;
    const auto place = lines_.mark();
    const bool title = lines_.next();
    const auto& fields = lines_.fields();
    const bool point = fields.size() >= 3 && std::all_of(fields.begin() + 1, fields.end(), is_number);
    bool enough = title;
    for (std::uint32_t i = 0; enough && i < announced_; ++i) enough = lines_.next_content() && !is_count();
    lines_.return_to(place);
    if (!enough && point && !std::exchange(said_untitled_, true))
      curves_.warnings.emplace_back("there is no title line after the number of points");
    return enough || !point;
  }

  ExtendedXyz read_title(bool first) {
    if (!lines_.next()) return {};
    try {
      ExtendedXyz title = parse_extended_xyz(lines_.line());
      if (first && !title.unread.empty() && options_.columns.empty())
        curves_.warnings.push_back(fmt::format("not read: {}", fmt::join(title.unread, ", ")));
      return title;
    } catch (const InputError& error) {
      lines_.fail(error.what());
    }
  }

  // A box of catena's has its edge a along x, b in the plane of x and y; another would have to be turned, and
  // the spheres with it, which rounds them.
  void take_box(const ExtendedXyz& title, bool first) {
    const auto& periodic = title.periodic;
    const bool repeats = title.lattice && (periodic[0] || periodic[1] || periodic[2]);
    if (!first && repeats != has_box_)
      lines_.fail("this frame and the first differ in having a periodic Lattice");
    has_box_ = repeats;
    if (!repeats) return;
    const auto [ax, ay, az, bx, by, bz, cx, cy, cz] = *title.lattice;
    if (ay != 0 || az != 0 || bz != 0 || ax <= 0 || by <= 0 || cz <= 0) {
      if (!first && !curves_.boxes.empty())
        lines_.fail("this Lattice does not lie along the axes, as the first does");
      if (first)
        curves_.warnings.push_back(fmt::format(
            "line {}: the Lattice is left out, and nothing is periodic, as its first edge is not along x, "
            "its second not in x and y, or one of the three leads backwards or nowhere",
            lines_.line_number()));
      return;
    }
    if (!first && curves_.boxes.empty()) lines_.fail("this Lattice lies along the axes, the first does not");
    curves_.boxes.push_back({{periodic[0] ? ax : 0, periodic[1] ? by : 0, periodic[2] ? cz : 0}, bx, cx, cy});
  }

  void choose_columns(const ExtendedXyz& title, const std::vector<std::string_view>& row, bool first) {
    TableColumns columns;
    if (!options_.columns.empty())
      columns = TableColumns::of_option(options_.columns);
    else if (title.columns)
      columns = *title.columns;
    else if (first)
      columns = columns_of_row(row, true, lines_);
    else
      return;
    if (!first && columns.has_radii() != curves_.has_radii)
      lines_.fail("this frame and the first differ in having radii");
    points_.set_columns(std::move(columns));
  }

  TextLines& lines_;
  const ReadOptions& options_;
  CurveFile& curves_;
  TablePoints points_;
  std::uint32_t announced_ = 0;
  bool said_untitled_ = false;
  bool has_box_ = false;  ///< the title of the frame before says that space repeats
};

}  // namespace

void read_xyz_frames(TextLines& lines, const ReadOptions& options, CurveFile& curves) {
  XyzFrames(lines, options, curves).read();
}

}  // namespace catena
