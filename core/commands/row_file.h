#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catena/core/output_file.h"

namespace catena {

/// Rows of a table as text: CSV (RFC 4180: text with a comma, a quote or a line end is in quotes), or one
/// JSON object a line where the name of the table's file ends in .jsonl, in letters of any case.
class RowText {
 public:
  RowText(const std::string& file_name, std::vector<std::string> columns);

  /// The line of names; nothing for JSON.
  std::string heading() const;
  /// The next cell of the row under way; there must be one for each column.
  RowText& number(std::uint64_t value);
  RowText& real(double value);  ///< the shortest text that reads as it
  RowText& text(std::string_view value);
  void end_row();
  /// The rows since the last call.
  std::string take() { return std::exchange(text_, {}); }

 private:
  void begin_cell();

  std::vector<std::string> columns_;
  bool json_;
  std::string text_;
  std::size_t cells_ = 0;
};

/// A table being written, whole or not at all. Throws as OutputFile does.
class RowFile {
 public:
  RowFile(const std::string& name, std::vector<std::string> columns) : out_(name), row_(name, std::move(columns)) {
    out_.write(row_.heading());
  }
  RowText& row() { return row_; }  ///< for cells
  void end_row() {
    row_.end_row();
    out_.write(row_.take());
  }
  void close() { out_.close(); }

 private:
  OutputFile out_;
  RowText row_;
};

}  // namespace catena
