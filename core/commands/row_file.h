#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/output_file.h"

namespace catena {

/// A table being written, whole or not at all: CSV with a line of names (RFC 4180: text with a comma, a quote
/// or a line end is in quotes), or one JSON object a line where the file's name ends in .jsonl. Throws as
/// OutputFile does.
class RowFile {
 public:
  RowFile(const std::string& name, std::vector<std::string> columns);

  /// The next cell of the row under way; there must be one for each column.
  RowFile& number(std::uint64_t value);
  RowFile& real(double value);  ///< the shortest text that reads as it
  RowFile& text(std::string_view value);
  void end_row();

  void close() { out_.close(); }

 private:
  void begin_cell();

  OutputFile out_;
  std::vector<std::string> columns_;
  bool json_;
  std::string line_;
  std::size_t cells_ = 0;
};

}  // namespace catena
