#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "catena/core/readers/number_text.h"
#include "catena/core/readers/reader.h"
#include "catena/core/readers/text_lines.h"

/// Columns of text, `x y z`, in the many dialects of .xyz and .txt: perhaps a line with the number of points,
/// perhaps a title, perhaps an element or an id before x, perhaps more columns after z, which are never
/// radii; `END` on a line ends a strand, `#` starts a comment. Columns are separated by blanks or commas.
///
/// The first of four or more numbers is an id, not x, when it is a whole number without point or exponent on
/// every line and either grows from line to line of each strand, or stands under a count line (there it is
/// the atom).
namespace catena {
namespace {

struct Row {
  std::size_t line;
  std::vector<std::string> numbers;  ///< without the element
};

/// The numbers of a row; none when the line is not one (a title).
std::vector<std::string> numbers_of(const std::vector<std::string_view>& fields) {
  const std::size_t element = !fields.empty() && !is_number(fields[0]) ? 1 : 0;
  std::vector<std::string> numbers(fields.begin() + static_cast<std::ptrdiff_t>(element), fields.end());
  if (numbers.size() < 3 || !std::all_of(numbers.begin(), numbers.begin() + 3, is_number)) return {};
  return numbers;
}

class PointColumns {
 public:
  PointColumns(const std::filesystem::path& file, const ReadOptions& options)
      : lines_(file), curves_(options) {}

  CurveFile curves() {
    while (!over_ && lines_.next()) {
      blank_lines_inside_ += !rows_.empty() && trimmed(lines_.line()).empty();
      lines_.cut_comment('#');
      if (!lines_.line().empty()) read_line();
    }
    check_count();
    const std::size_t first = first_column_is_id() ? 1 : 0;
    if (!rows_.empty() && rows_[0].numbers.size() > 3 + first)
      warn("columns after z are not read, as they need not be radii");
    if (first == 1) warn("the first column is taken for ids");
    if (blank_lines_seen_ > 0) warn("blank lines do not end a strand; END does");
    std::size_t end = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (end < ends_.size() && ends_[end] == i) curves_.end_strand(), ++end;
      add_point(rows_[i], first);
    }
    curves_.end_strand();
    return std::move(curves_);
  }

 private:
  void read_line() {
    const auto& fields = lines_.fields(" \t,");
    if (fields.empty()) lines_.fail("a line of separators only; a point is x y z");
    if (const std::string word = lower_case(fields[0]); word == "end" || word == "endmdl") {
      ends_.push_back(rows_.size());
      return;
    }
    if (fields.size() == 1 && is_integer(fields[0])) return read_count(fields[0]);
    auto numbers = numbers_of(fields);
    if (numbers.empty()) {
      if (!rows_.empty() || has_title_)
        lines_.fail(fmt::format("a point needs three coordinates, got {} columns", fields.size()));
      has_title_ = true;
      return;
    }
    if (!rows_.empty() && rows_[0].numbers.size() != numbers.size())
      lines_.fail(fmt::format("{} columns of numbers, but line {} has {}", numbers.size(), rows_[0].line,
                              rows_[0].numbers.size()));
    blank_lines_seen_ = blank_lines_inside_;
    rows_.push_back({lines_.line_number(), std::move(numbers)});
  }

  void read_count(std::string_view text) {
    if (count_ && !rows_.empty()) {
      warn("only the first of several frames is read");
      over_ = true;
      return;
    }
    if (count_ || has_title_ || !rows_.empty()) lines_.fail("a point needs three coordinates, got 1 column");
    count_ = lines_.count(text, "number of points");
    count_line_ = lines_.line_number();
  }

  // The line after the count is a title by the format; one that looks like a point is known by the number of
  // rows.
  void check_count() {
    if (!count_ || rows_.size() == *count_) return;
    const bool title_of_numbers =
        !has_title_ && rows_.size() == std::size_t{*count_} + 1 && rows_[0].line == count_line_ + 1;
    if (!title_of_numbers)
      lines_.fail_at(count_line_, fmt::format("{} points are announced, {} follow", *count_, rows_.size()));
    rows_.erase(rows_.begin());
    for (auto& end : ends_) end -= end > 0;
  }

  bool first_column_is_id() const {
    if (rows_.empty() || rows_[0].numbers.size() < 4) return false;
    const auto whole = [](const Row& row) { return is_integer(row.numbers[0]); };
    if (!std::ranges::all_of(rows_, whole)) return false;
    if (count_) return true;
    bool grows = rows_.size() > 1;
    for (std::size_t i = 1; i < rows_.size(); ++i)
      if (!std::ranges::binary_search(ends_, i))
        grows =
            grows && parse_integer(rows_[i - 1].numbers[0]).value < parse_integer(rows_[i].numbers[0]).value;
    return grows;
  }

  void add_point(const Row& row, std::size_t first) {
    float coordinate[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [value, problem] = parse_float(row.numbers[first + axis]);
      if (!problem.empty())
        lines_.fail_at(row.line, fmt::format("{} '{}' {}", "xyz"[axis], row.numbers[first + axis], problem));
      coordinate[axis] = value;
    }
    curves_.spheres.push_back({coordinate[0], coordinate[1], coordinate[2], 0});
  }

  void warn(const std::string& text) { curves_.warnings.push_back(text); }

  TextLines lines_;
  std::optional<std::uint32_t> count_;
  std::size_t count_line_ = 0;
  bool has_title_ = false, over_ = false;
  std::size_t blank_lines_inside_ = 0, blank_lines_seen_ = 0;
  std::vector<Row> rows_;
  std::vector<std::size_t> ends_;  ///< a strand ends before these rows
  CurveFile curves_;
};

const RegisterReader registered{
    {"xyz columns", {".xyz", ".txt"}, "x y z in columns; no radii", "point number from 0"},
    read_by<PointColumns>};

}  // namespace
}  // namespace catena
