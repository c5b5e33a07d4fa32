#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace catena {

/// A text file line by line: what every text reader scans with, and how it says what is wrong where. Lines
/// end with LF, CRLF or CR; a byte order mark is skipped. O(size of the file) memory and time.
class TextLines {
 public:
  /// Throws InputError unless the file can be read (see read_bytes) and has no byte 0.
  explicit TextLines(const std::filesystem::path& file);

  /// Goes to the next line; false when there is none. The first call goes to the first line.
  bool next();

  /// Goes to the next line that holds more than blanks and a comment after `mark`, and takes both off it.
  bool next_content(char mark = '#');

  /// From here on the memory of lines that were read is given back; return_to() must not go back to them.
  void read_once() { once_ = true, released_ = next_; }

  /// A place in the file to come back to: after return_to(mark()) the next line is the same again.
  struct Mark {
    std::size_t next, number;
  };
  Mark mark() const { return {next_, number_}; }
  void return_to(Mark mark) { next_ = line_feed_ = mark.next, number_ = mark.number, line_ = {}; }

  std::string_view line() const { return line_; }      ///< without its end
  std::size_t line_number() const { return number_; }  ///< from 1; stays at the last line after the end
  /// Of the whole file, a limit of any count it can hold.
  std::size_t bytes() const { return bytes_.size(); }
  const std::string& file_name() const { return name_; }

  /// Frees the text; nothing more can be read, and what was read of it is gone.
  void forget() {
    std::exchange(bytes_, {});  // an assignment would keep the memory
    line_ = {};
    next_ = line_feed_ = 0;
  }

  /// Cuts the line at the first `mark`, and blanks from both its ends.
  void cut_comment(char mark);

  /// The parts of the line between runs of blanks; none is empty. Valid until the next line is read.
  const std::vector<std::string_view>& fields() { return split(' '); }

  /// Those between blanks, commas, or commas among blanks. Throws InputError where a comma has nothing in
  /// front of it: what stands in the columns after an empty one would be taken for others.
  const std::vector<std::string_view>& columns();

  /// Throws InputError "file:line: reason", for the current line or another.
  [[noreturn]] void fail(const std::string& reason) const { fail_at(number_, reason); }
  [[noreturn]] void fail_at(std::size_t line_number, const std::string& reason) const;

  /// Numbers; `what` names the value in the error of the current line: "x", "radius".
  float real(std::string_view text, std::string_view what) const;
  double coordinate(std::string_view text, std::string_view what) const;  ///< see parse_coordinate
  double wide_real(std::string_view text, std::string_view what) const;
  /// A real that is not negative, and 0 only where it says so.
  float radius(std::string_view text) const;
  float half(std::string_view diameter) const;  ///< of such a one, as a radius
  std::int64_t integer(std::string_view text, std::string_view what) const;
  std::uint32_t count(std::string_view text, std::string_view what) const;  ///< an integer from 0 to 2^32 - 1

 private:
  float size(std::string_view text, std::string_view what, float parts = 1) const;
  /// At blanks and at `separator`.
  const std::vector<std::string_view>& split(char separator);
  std::size_t end_of_line() const;

  std::string name_, bytes_;
  std::size_t next_ = 0, number_ = 0;
  bool once_ = false;
  std::size_t released_ = 0;
  mutable std::size_t line_feed_ = 0;  ///< the first from next_ on, where it is not before that
  std::string_view line_;
  std::vector<std::string_view> fields_;
};

/// Text without the blanks (space, tab, and what remains of odd line ends) around it.
std::string_view trimmed(std::string_view text);

/// ASCII letters in lower case, for keywords and column names.
std::string lower_case(std::string_view text);

}  // namespace catena
