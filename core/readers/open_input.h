#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

namespace catena {

/// What is read to its end: a file, or standard input. A stream of the standard library takes an error there
/// for the end, and goes on with half of the spheres.
///
/// Every function throws InputError, with the name and the system's reason.
class OpenInput {
 public:
  explicit OpenInput(const std::filesystem::path& file);  ///< `-` is standard input
  ~OpenInput();
  OpenInput(const OpenInput&) = delete;
  OpenInput& operator=(const OpenInput&) = delete;

  /// How much a regular file has left, as the system says: 0 may be where there are bytes, as in /proc. Else
  /// 0.
  std::size_t told_size() const;
  /// The next bytes, fewer than `most` only at the end. Where a pipe or terminal is set not to wait, this
  /// does.
  std::size_t read(char* to, std::size_t most);
  /// All that is left.
  std::string read_all();

 private:
  [[noreturn]] void fail(int reason) const;

  bool is_standard_input_;
  std::string shown_;
  int descriptor_;  ///< opened last: then errno says why not
};

}  // namespace catena
