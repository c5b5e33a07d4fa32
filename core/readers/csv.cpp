#include <algorithm>
#include <string>

#include "catena/core/error.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/table_columns.h"
#include "catena/core/readers/table_points.h"
#include "catena/core/readers/text_lines.h"

/// Tables with a header line that names the columns as TableColumns does, in any order. Other columns are not
/// read, and named. Separated by comma, semicolon or tab, whichever the header has; cells may be
/// quoted, with quotation marks doubled; `#` starts a comment line.
namespace catena {
namespace {

using Role = TableColumns::Role;

constexpr std::string_view blanks = " \t\v\f";

/// Takes the quoted text at the front off the line, a doubled quotation mark being one, and appends it. False
/// where the quotes are not closed, or more than blanks follow them in the cell.
bool take_quoted(std::string_view& line, char separator, std::string& text) {
  for (std::size_t at = 1; at < line.size(); ++at) {
    if (line[at] == '"' && line.substr(at + 1).starts_with('"')) {
      ++at;
    } else if (line[at] == '"') {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      if (!trimmed(line.substr(at + 1, end - at - 1)).empty()) return false;
      line.remove_prefix(end);
      return true;
    }
    text += line[at];
  }
  return false;
}

/// The cells of a line, without the blanks and quotes around them; valid while the line and `unquoted` are.
/// Throws InputError, without a place, for quotes that do not hold a whole cell.
void split(std::string_view line, char separator, std::vector<std::string_view>& cells,
           std::string& unquoted) {
  cells.clear();
  unquoted.clear();
  unquoted.reserve(line.size());  // so that no text moves
  for (bool more = true; more;) {
    const std::size_t begin = std::min(line.find_first_not_of(blanks), line.size());
    const std::size_t end = std::min(line.find(separator), line.size());
    if (begin < end && line[begin] == '"') {
      line.remove_prefix(begin);
      const std::size_t first = unquoted.size();
      if (!take_quoted(line, separator, unquoted))
        throw InputError(
            "a quotation mark is not closed at the end of its cell; double those that are part of one");
      cells.push_back(std::string_view(unquoted).substr(first));
    } else {
      cells.push_back(trimmed(line.substr(0, end)));
      line.remove_prefix(end);
    }
    more = !line.empty();
    if (more) line.remove_prefix(1);
  }
}

class Table {
 public:
  Table(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), curves_(options), given_(options.columns), points_(lines_, curves_) {}

  CurveFile curves() {
    lines_.read_once();
    if (!next_row()) lines_.fail("the file has no header line; name the columns: x,y,z,r");
    choose_separator();
    split_line();
    if (given_.empty())
      points_.set_columns_named(cells_);
    else
      take_given_columns();
    while (next_row()) {
      split_line();
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

  void split_line() {
    try {
      split(lines_.line(), separator_, cells_, unquoted_);
    } catch (const InputError& error) {
      lines_.fail(error.what());
    }
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
