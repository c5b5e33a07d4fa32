#include <algorithm>
#include <string>

#include "catena/core/readers/number_text.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/row_columns.h"
#include "catena/core/readers/table_points.h"
#include "catena/core/readers/text_lines.h"
#include "catena/core/readers/xyz_frames.h"

/// Points in columns of text: XYZ, which starts with a number of points, or rows alone. Rows alone may have a
/// first line that names the columns; `END` on a line ends a strand. Columns are separated by blanks or
/// commas, `#` starts a comment. Rows that could be read in more than one way are refused; --columns says
/// which.
namespace catena {
namespace {

using Role = TableColumns::Role;

class PointColumns {
 public:
  PointColumns(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), options_(options), curves_(options), points_(lines_, curves_) {}

  CurveFile curves() {
    const auto start = lines_.mark();
    const bool counted = lines_.next_content() && is_count();
    lines_.return_to(start);
    if (counted)
      read_xyz_frames(lines_, options_, curves_);
    else
      read_rows();
    return std::move(curves_);
  }

 private:
  bool is_count() {
    const auto& fields = lines_.columns();
    return fields.size() == 1 && is_integer(fields[0]);
  }

  void read_rows() {
    bool blank_line = false;
    while (lines_.next()) {
      const bool blank = trimmed(lines_.line()).empty();
      lines_.cut_comment('#');
      blank_line = blank_line || (blank && !curves_.spheres.empty());
      if (lines_.line().empty()) continue;
      blank_line_inside_ = blank_line_inside_ || blank_line;
      read_row(lines_.columns());
    }
    points_.finish();
    if (blank_line_inside_) curves_.warnings.emplace_back("blank lines do not end a strand; END does");
  }

  void read_row(const std::vector<std::string_view>& row) {
    if (row.empty()) lines_.fail("a line of separators only; a point is x y z");
    if (const std::string word = lower_case(row[0]); row.size() == 1 && (word == "end" || word == "endmdl"))
      return points_.end_strand();
    if (points_.columns().size() == 0 && !take_columns(row)) return;
    points_.add(row);
  }

  /// Of the first row; false when it is a header.
  bool take_columns(const std::vector<std::string_view>& row) {
    if (!options_.columns.empty()) points_.set_columns(TableColumns::of_option(options_.columns));
    const auto names = [&](Role role) {
      return std::ranges::any_of(row,
                                 [&](std::string_view name) { return TableColumns::role_of(name) == role; });
    };
    const bool header = names(Role::x) && names(Role::y) && names(Role::z);
    if (!options_.columns.empty()) return !header;
    if (header)
      points_.set_columns_named(row);
    else
      points_.set_columns(columns_of_row(row, false, lines_));
    if (!header && row.size() > 3)
      curves_.warnings.emplace_back("the words in the first column are taken for elements");
    return !header;
  }

  TextLines lines_;
  const ReadOptions& options_;
  CurveFile curves_;
  TablePoints points_;
  bool blank_line_inside_ = false;
};

const RegisterReader registered{
    {"xyz columns",
     {".xyz", ".txt"},
     "XYZ and extended XYZ, a frame for each of theirs; or rows of x y z; --columns for others",
     "id; or element and number from 1; or line",
     {"--columns"}},
    read_by<PointColumns>};

}  // namespace
}  // namespace catena
