#include "catena/core/readers/binary_fields.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"

namespace catena {

BinaryFields::BinaryFields(const std::filesystem::path& file, Order order)
    : name_(file.string()), bytes_(read_bytes(file)), order_(order) {}

void BinaryFields::require(std::uint64_t count, std::uint64_t size, std::string_view what) const {
  if (count > left() / size)
    fail(fmt::format("the file is truncated: {} {} of {} bytes are due, {} bytes are left", count, what, size,
                     left()));
}

std::string_view BinaryFields::text(std::uint64_t size, std::string_view what) {
  require(size, 1, what);
  const auto part = std::string_view(bytes_).substr(at_, size);
  at_ += size;
  return part;
}

std::uint64_t BinaryFields::bits(unsigned size, std::string_view what) {
  require(1, size, what);
  std::uint64_t value = 0;
  for (unsigned byte = 0; byte < size; ++byte) {
    const unsigned place = order_ == Order::little ? byte : size - 1 - byte;
    value |= std::uint64_t{static_cast<unsigned char>(bytes_[at_ + byte])} << (8 * place);
  }
  at_ += size;
  return value;
}

float BinaryFields::raw_f32(std::string_view what) { return std::bit_cast<float>(u32(what)); }

float BinaryFields::f32(std::string_view what) {
  const float value = raw_f32(what);
  if (!std::isfinite(value)) {
    at_ -= 4;
    fail(fmt::format("{} is {}, not a finite number", what, value));
  }
  return value;
}

void BinaryFields::fail(const std::string& reason) const {
  throw InputError(fmt::format("{}: byte {}: {}", name_, at_, reason));
}

}  // namespace catena
