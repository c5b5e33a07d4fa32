#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace catena {

/// A binary file read front to back, field by field, in a byte order of its own whatever the machine's.
/// Everything is checked against the size of the file before it is read.
class BinaryFields {
 public:
  enum class Order { little, big };

  /// Throws InputError unless the file can be read (see read_bytes).
  explicit BinaryFields(const std::filesystem::path& file, Order order = Order::little);

  void set_order(Order order) { order_ = order; }
  std::uint64_t position() const { return at_; }
  std::uint64_t size() const { return bytes_.size(); }
  std::uint64_t left() const { return bytes_.size() - at_; }
  const std::string& file_name() const { return name_; }
  /// Frees the file; nothing more can be read.
  void forget() {
    std::exchange(bytes_, {});  // an assignment would keep the memory
    at_ = 0;
  }

  /// Throws InputError unless `count` items of `size` bytes are left: before memory is asked for. No
  /// overflow.
  void require(std::uint64_t count, std::uint64_t size, std::string_view what) const;

  std::string_view text(std::uint64_t size, std::string_view what);
  /// Of text between binary parts. A line ends with LF, CRLF or the file, and comes without its end; a word
  /// comes without the blanks and line ends around it, and is never empty.
  std::string_view line(std::string_view what);
  std::string_view word(std::string_view what);
  std::string_view next_word() const;  ///< without going on; empty at the end of the file
  void go_to(std::uint64_t position);  ///< throws InputError when it is past the end
  void skip(std::uint64_t size, std::string_view what) { text(size, what); }
  std::uint16_t u16(std::string_view what) { return static_cast<std::uint16_t>(bits(2, what)); }
  std::uint32_t u32(std::string_view what) { return static_cast<std::uint32_t>(bits(4, what)); }
  std::int32_t i32(std::string_view what) { return static_cast<std::int32_t>(u32(what)); }
  float raw_f32(std::string_view what);  ///< any value, NaN too
  float f32(std::string_view what);      ///< throws InputError unless finite
  std::uint64_t unsigned_of(unsigned size, std::string_view what) {
    return bits(size, what);
  }                                       ///< 1, 2, 4 or 8 bytes
  double raw_f64(std::string_view what);  ///< any value, NaN too

  /// Throws InputError "file: byte N: reason".
  [[noreturn]] void fail(const std::string& reason) const;
  [[noreturn]] void fail_at_line(
      const std::string& reason) const;  ///< "file:line: reason", of the last byte that was read

 private:
  std::uint64_t bits(unsigned size, std::string_view what);

  std::string name_, bytes_;
  Order order_;
  std::uint64_t at_ = 0;
};

}  // namespace catena
