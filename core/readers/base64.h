#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace catena {

/// Base64 (RFC 4648) read piece by piece. Blanks and line ends are skipped; padding ends four letters, not
/// the data, as VTK puts one padded text behind another.
class Base64 {
 public:
  explicit Base64(std::string_view text) : text_(text) {}

  /// Appends the next `size` bytes; false when the text ends before, or is no base64.
  bool read(std::size_t size, std::string& bytes);

 private:
  bool decode_four();

  std::string_view text_;
  std::array<char, 3> decoded_{};  ///< of the last four letters
  std::size_t used_ = 0, filled_ = 0;
};

}  // namespace catena
