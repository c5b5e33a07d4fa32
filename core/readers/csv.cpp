#include <algorithm>
#include <string>

#include "catena/core/readers/number_text.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/table_columns.h"
#include "catena/core/readers/table_points.h"
#include "catena/core/readers/text_lines.h"

/// Tables with a header line that names the columns as TableColumns does, in any order. Other columns are not
/// read, and named. Separated by comma, semicolon or tab, whichever the header has; cells may be quoted; `#`
/// starts a comment line.
namespace catena {
namespace {

using Role = TableColumns::Role;

/// The cells of a line, without the blanks and quotes around them; valid while the line and `unquoted` are.
void split(std::string_view line, char separator, std::vector<std::string_view>& cells,
           std::string& unquoted) {
  cells.clear();
  if (line.find('"') != std::string_view::npos) {
    constexpr char end_of_cell = '\0';
    unquoted.clear();
    bool quoted = false;
    for (const char c : line)
      if (c == '"')
        quoted = !quoted;
      else
        unquoted += c == separator && !quoted ? end_of_cell : c;
    line = unquoted;
    separator = end_of_cell;
  }
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
}

class Table {
 public:
  Table(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), curves_(options), given_(options.columns), points_(lines_, curves_) {}

  CurveFile curves() {
    if (!next_row()) lines_.fail("the file has no header line; name the columns: x,y,z,r");
    choose_separator();
    split(lines_.line(), separator_, cells_, unquoted_);
    if (given_.empty())
      points_.set_columns_named(cells_);
    else
      take_given_columns();
    while (next_row()) {
      split(lines_.line(), separator_, cells_, unquoted_);
      read_row();
    }
    points_.finish();
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

  void choose_separator() {
    for (const char candidate : {',', ';', '\t'})
      if (lines_.line().find(candidate) != std::string_view::npos) {
        separator_ = candidate;
        return;
      }
  }

  // The first line is a header, as the format has one, unless it holds a point.
  void take_given_columns() {
    points_.set_columns(TableColumns::of_option(given_));
    const auto& columns = points_.columns();
    const auto is_word = [&](Role role) {
      return columns.place(role) < cells_.size() && !is_number(cells_[columns.place(role)]);
    };
    if (!is_word(Role::x) || !is_word(Role::y) || !is_word(Role::z)) read_row();
  }

  void read_row() {
    // Spreadsheets add empty cells.
    while (cells_.size() > points_.columns().size() && cells_.back().empty()) cells_.pop_back();
    points_.add(cells_);
  }

  TextLines lines_;
  CurveFile curves_;
  std::vector<std::string> given_;
  TablePoints points_;
  char separator_ = ',';
  std::vector<std::string_view> cells_;
  std::string unquoted_;
};

const RegisterReader registered{
    {"CSV table",
     {".csv"},
     "x, y, z and perhaps radius or diameter, id, strand, by the names in its first line",
     "id, or line",
     {"--columns"}},
    read_by<Table>};

}  // namespace
}  // namespace catena
