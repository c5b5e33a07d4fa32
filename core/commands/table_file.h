#pragma once
#include <fmt/os.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>

#include "catena/core/error.h"

namespace catena {

/// A CSV file being written. It gets its name only when it is complete, so that a failed run leaves no half
/// table and does not touch an older one.
class TableFile {
 public:
  /// Throws InputError, naming the file and the system's reason, when it cannot be written.
  TableFile(const std::string& name, const char* header) : name_(name), unfinished_(name + ".unfinished") {
    attempt([&] { out_.emplace(fmt::output_file(unfinished_)); });
    row("{}\n", header);
  }
  ~TableFile() {
    if (!out_) return;
    out_.reset();
    std::remove(unfinished_.c_str());
  }
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;

  template <class... Values>
  void row(fmt::format_string<const Values&...> format, const Values&... values) {
    attempt([&] { out_->print(format, values...); });
  }
  void close() {
    attempt([&] { out_->close(); });
    out_.reset();
    if (std::rename(unfinished_.c_str(), name_.c_str()) != 0)
      throw InputError("cannot write " + name_ + ": " + std::strerror(errno));
  }

 private:
  template <class Write>
  void attempt(const Write& write) {
    try {
      write();
    } catch (const std::system_error& error) {
      throw InputError("cannot write " + name_ + ": " + error.code().message());
    }
  }

  std::string name_, unfinished_;
  std::optional<fmt::ostream> out_;
};

}  // namespace catena
