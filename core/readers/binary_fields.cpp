#include "catena/core/readers/binary_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/readers/file_bytes.h"

namespace catena {

BinaryFields::BinaryFields(const std::filesystem::path& file, Order order)
    : name_(shown_name(file)), bytes_(read_bytes(file)), order_(order) {}

void BinaryFields::require(std::uint64_t count, std::uint64_t size, std::string_view what) const {
  if (size != 0 && count > left() / size)
    fail(fmt::format("the file is truncated: {} left, too few for {}", counted(left(), "byte"),
                     count == 1 || size == 1
                         ? fmt::format("{} ({})", what, counted(count == 1 ? size : count, "byte"))
                         : fmt::format("{} {} of {}", count, what, counted(size, "byte"))));
}

std::string_view BinaryFields::text(std::uint64_t size, std::string_view what) {
  require(size, 1, what);
  const auto part = std::string_view(bytes_).substr(at_, size);
  at_ += size;
  return part;
}

std::string_view BinaryFields::line(std::string_view what) {
  require(1, 1, what);
  const std::string_view rest = std::string_view(bytes_).substr(at_);
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  at_ += std::min(end + 1, rest.size());
  const std::string_view content = rest.substr(0, end);
  return content.ends_with('\r') ? content.substr(0, end - 1) : content;
}

std::string_view BinaryFields::next_word() const {
  const auto is_blank = [](char c) { return c == ' ' || ('\t' <= c && c <= '\r'); };
  std::size_t begin = at_;
  while (begin < bytes_.size() && is_blank(bytes_[begin])) ++begin;
  std::size_t end = begin;
  while (end < bytes_.size() && !is_blank(bytes_[end])) ++end;
  return std::string_view(bytes_).substr(begin, end - begin);
}

std::string_view BinaryFields::word(std::string_view what) {
  const std::string_view found = next_word();
  if (found.empty()) fail(fmt::format("the file is truncated: {} is due", what));
  at_ = static_cast<std::uint64_t>(found.data() - bytes_.data()) + found.size();
  return found;
}

void BinaryFields::go_to(std::uint64_t position) {
  if (position > bytes_.size())
    fail(fmt::format("the data is said to begin at byte {} of {}", position, bytes_.size()));
  at_ = position;
}

double BinaryFields::raw_f64(std::string_view what) { return std::bit_cast<double>(bits(8, what)); }

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

void BinaryFields::fail_at_line(const std::string& reason) const {
  const auto last = static_cast<std::ptrdiff_t>(at_ > 0 ? at_ - 1 : 0);
  const auto lines = std::count(bytes_.begin(), bytes_.begin() + last, '\n');
  throw InputError(fmt::format("{}:{}: {}", name_, lines + 1, reason));
}

}  // namespace catena
