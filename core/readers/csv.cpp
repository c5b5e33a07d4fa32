#include <fmt/format.h>

#include <optional>
#include <string>

#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Tables with a header line that names the columns, in any order: x, y, z; perhaps one of r, radius, d,
/// diameter; perhaps strand, whose change starts a strand. A unit in brackets after a name is ignored, other
/// columns too. Separated by comma, semicolon or tab, whichever the header has; cells may be quoted; `#`
/// starts a comment line.
namespace catena {
namespace {

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted_part = false;
  for (const char c : line) {
    if (c == '"')
      quoted_part = !quoted_part;
    else if (c == separator && !quoted_part)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  for (auto& cell : cells) cell = trimmed(cell);
  return cells;
}

class Table {
 public:
  Table(const std::filesystem::path& file, const ReadOptions& options) : lines_(file), curves_(options) {}

  CurveFile curves() {
    if (!next_row()) lines_.fail("the file has no header line; name the columns: x,y,z,r");
    read_header();
    curves_.has_radii = radius_ || diameter_;
    while (next_row()) read_row();
    curves_.end_strand();
    return std::move(curves_);
  }

 private:
  bool next_row() {
    while (lines_.next()) {
      const std::string_view text = trimmed(lines_.line());
      if (!text.empty() && text[0] != '#') return true;
    }
    return false;
  }

  void read_header() {
    const std::string_view line = lines_.line();
    for (const char candidate : {',', ';', '\t'})
      if (line.find(candidate) != std::string_view::npos) {
        separator_ = candidate;
        break;
      }
    const auto names = cells_of(line, separator_);
    columns_ = names.size();
    for (std::size_t column = 0; column < columns_; ++column) {
      const std::string name =
          lower_case(trimmed(std::string_view(names[column]).substr(0, names[column].find_first_of("[("))));
      if (name == "x") set(x_, column, name);
      if (name == "y") set(y_, column, name);
      if (name == "z") set(z_, column, name);
      if (name == "r" || name == "radius") set(radius_, column, name);
      if (name == "d" || name == "diameter") set(diameter_, column, name);
      if (name == "strand") set(strand_, column, name);
    }
    if (!x_ || !y_ || !z_) lines_.fail("the header must name the columns x, y and z, and perhaps r");
    if (radius_ && diameter_) lines_.fail("both a radius and a diameter column; keep one of them");
  }

  void set(std::optional<std::size_t>& role, std::size_t column, const std::string& name) const {
    if (role)
      lines_.fail(fmt::format("columns {} and {} mean the same: {}", *role + 1, column + 1, in_quotes(name)));
    role = column;
  }

  void read_row() {
    auto cells = cells_of(lines_.line(), separator_);
    while (cells.size() > columns_ && cells.back().empty()) cells.pop_back();  // spreadsheets add empty cells
    if (cells.size() != columns_)
      lines_.fail(fmt::format("the row has {} columns, the header {}", cells.size(), columns_));
    if (strand_ && cells[*strand_] != strand_name_) {
      curves_.end_strand();
      strand_name_ = cells[*strand_];
    }
    float radius = 0;
    if (radius_) radius = lines_.radius(cells[*radius_]);
    if (diameter_) radius = lines_.radius(cells[*diameter_]) / 2;
    curves_.add_point(lines_.coordinate(cells[*x_], "x"), lines_.coordinate(cells[*y_], "y"),
                      lines_.coordinate(cells[*z_], "z"), radius);
  }

  TextLines lines_;
  char separator_ = ',';
  std::size_t columns_ = 0;
  std::optional<std::size_t> x_, y_, z_, radius_, diameter_, strand_;
  std::string strand_name_;
  CurveFile curves_;
};

const RegisterReader registered{{"CSV table",
                                 {".csv"},
                                 "columns x,y,z and perhaps radius or diameter, by their header",
                                 "point number from 0"},
                                read_by<Table>};

}  // namespace
}  // namespace catena
