#pragma once
#include <fmt/format.h>

#include <iterator>
#include <string>

#include "catena/core/output_file.h"

namespace catena {

/// A CSV file being written, whole or not at all. Throws as OutputFile does.
class TableFile {
 public:
  TableFile(const std::string& name, const char* header) : out_(name) { row("{}\n", header); }

  template <class... Values>
  void row(fmt::format_string<const Values&...> format, const Values&... values) {
    line_.clear();
    fmt::format_to(std::back_inserter(line_), format, values...);
    out_.write(line_);
  }
  void close() { out_.close(); }

 private:
  OutputFile out_;
  std::string line_;
};

}  // namespace catena
