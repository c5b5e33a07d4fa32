#include "catena/core/readers/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/number_text.h"

namespace catena {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

TextLines::TextLines(const std::filesystem::path& file) : name_(shown_name(file)), bytes_(read_bytes(file)) {
  if (bytes_.starts_with("\xEF\xBB\xBF")) next_ = 3;
  // Where a part of a file was lost there may be zeros, which some formats would skip as a line that is not
  // theirs.
  if (const std::size_t zero = bytes_.find('\0'); zero != std::string::npos)
    throw InputError(
        fmt::format("{}: byte {} is 0, so this is no text; it is binary, damaged or UTF-16", name_, zero));
}

// A line feed is looked for once, also where thousands of lines end with CR alone.
std::size_t TextLines::end_of_line() const {
  if (line_feed_ < next_ || (line_feed_ < bytes_.size() && bytes_[line_feed_] != '\n'))
    line_feed_ = std::min(bytes_.find('\n', next_), bytes_.size());
  return next_ +
         std::min(std::string_view(bytes_).substr(next_, line_feed_ - next_).find('\r'), line_feed_ - next_);
}

bool TextLines::next() {
  if (next_ >= bytes_.size()) return false;
  constexpr std::size_t piece = std::size_t{4} << 20;
  if (once_ && next_ - released_ > piece) {
    release_pages(bytes_, released_, next_);
    released_ = next_;
  }
  const std::size_t end = end_of_line();
  line_ = std::string_view(bytes_).substr(next_, end - next_);
  next_ = end + (bytes_.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  ++number_;
  return true;
}

bool TextLines::next_content(char mark) {
  while (next()) {
    cut_comment(mark);
    if (!line_.empty()) return true;
  }
  return false;
}

void TextLines::cut_comment(char mark) { line_ = trimmed(line_.substr(0, line_.find(mark))); }

const std::vector<std::string_view>& TextLines::columns() {
  bool cell = false;  // since the last comma
  for (const char c : line_) {
    if (c == ',' && !cell)
      fail("a column in front of a comma is empty; write _ or 0 there, or use a .csv file");
    cell = c != ',' && (cell || !is_blank(c));
  }
  return split(',');
}

const std::vector<std::string_view>& TextLines::split(char separator) {
  fields_.clear();
  const char* const end = line_.data() + line_.size();
  for (const char* at = line_.data(); at != end;) {
    const char* const begin = at;
    while (at != end && !is_blank(*at) && *at != separator) ++at;
    if (at != begin) fields_.emplace_back(begin, at);
    if (at != end) ++at;
  }
  return fields_;
}

void TextLines::fail_at(std::size_t line_number, const std::string& reason) const {
  throw InputError(fmt::format("{}:{}: {}", name_, line_number, reason));
}

float TextLines::real(std::string_view text, std::string_view what) const {
  const auto [value, problem] = parse_float(text);
  if (!problem.empty()) fail(fmt::format("{} {} {}", what, in_quotes(text), problem));
  return value;
}

double TextLines::coordinate(std::string_view text, std::string_view what) const {
  const auto [value, problem] = parse_coordinate(text);
  if (!problem.empty()) fail(fmt::format("{} {} {}", what, in_quotes(text), problem));
  return value;
}

double TextLines::wide_real(std::string_view text, std::string_view what) const {
  const auto [value, problem] = parse_double(text);
  if (!problem.empty()) fail(fmt::format("{} {} {}", what, in_quotes(text), problem));
  return value;
}

float TextLines::radius(std::string_view text) const { return size(text, "radius"); }
float TextLines::half(std::string_view diameter) const { return size(diameter, "diameter", 2); }

float TextLines::size(std::string_view text, std::string_view what, float parts) const {
  const float value = real(text, what);
  if (value < 0) fail(fmt::format("{} {} is negative", what, in_quotes(text)));
  if (value / parts == 0 && !is_zero(text))
    fail(fmt::format("{} {} is no 0, but binary32 has no radius so small; scale the points and radii", what,
                     in_quotes(text)));
  return value / parts;
}

std::int64_t TextLines::integer(std::string_view text, std::string_view what) const {
  const auto [value, problem] = parse_integer(text);
  if (!problem.empty()) fail(fmt::format("{} {} {}", what, in_quotes(text), problem));
  return value;
}

std::uint32_t TextLines::count(std::string_view text, std::string_view what) const {
  const std::int64_t value = integer(text, what);
  constexpr std::int64_t greatest = std::numeric_limits<std::uint32_t>::max();
  if (value < 0 || value > greatest)
    fail(fmt::format("{} {} must be from 0 to {}", what, in_quotes(text), greatest));
  return static_cast<std::uint32_t>(value);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\v\f";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return 'A' <= c && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return lower;
}

}  // namespace catena
