#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "catena/core/readers/binary_fields.h"

namespace catena {

/// The words and numbers of a VTK legacy file, whose numbers are text or binary (big-endian). Throws
/// InputError, naming file and place, for what is none of the type.
class VtkNumbers {
 public:
  enum class Kind { floating, signed_integer, unsigned_integer };
  struct Type {
    unsigned size;
    Kind kind;
  };
  static constexpr Type int32{4, Kind::signed_integer};

  explicit VtkNumbers(const std::filesystem::path& file) : fields_(file, BinaryFields::Order::big) {}

  /// As its third line says; until then it is text.
  void are_ascii(bool ascii) { ascii_ = ascii; }
  bool ascii() const { return ascii_; }
  BinaryFields& fields() { return fields_; }

  /// The type of this name, in whatever case.
  Type type_of(const std::string& name) const;
  /// Of what is said to follow, where that can be known.
  void require(std::uint64_t count, std::uint64_t components, Type type) const {
    if (!ascii_) fields_.require(count, components * type.size, "values");
  }
  /// The count that this text is. Whatever is counted takes a byte at least, so that a damaged one asks for
  /// no memory.
  std::uint64_t count(const std::string& text, std::string_view what) const;

  double real(Type type, std::string_view what);
  double coordinate(Type type, std::string_view what);
  std::int64_t integer(Type type, std::string_view what);
  void skip(std::uint64_t values, Type type, const std::string& what);

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  BinaryFields fields_;
  bool ascii_ = true;
};

}  // namespace catena
