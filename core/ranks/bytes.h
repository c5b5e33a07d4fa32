#pragma once
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/ranks/communicator.h"

namespace catena::ranks {

/// Writes values one after the other into a message.
class ByteWriter {
 public:
  template <class Value>
  ByteWriter& put(const Value& value) {
    return put_all(std::span(&value, 1));
  }
  template <class Value>
  ByteWriter& put_all(std::span<const Value> values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto bytes = std::as_bytes(values);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  /// How many, then the values.
  template <class Value>
  ByteWriter& put_list(const std::vector<Value>& values) {
    put(std::uint64_t{values.size()});
    return put_all(std::span<const Value>(values));
  }
  void reserve(std::size_t bytes) {
    bytes_.reserve(bytes);
    wish_large_pages(bytes_.data(), bytes);
  }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Reads what a ByteWriter wrote; throws std::logic_error past its end. The bytes must outlive it.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class Value>
  Value get() {
    Value value;
    get_all(std::span(&value, 1));
    return value;
  }
  template <class Value>
  void get_all(std::span<Value> values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (values.size_bytes() > left_.size()) throw std::logic_error("a message ends too early");
    if (!values.empty()) std::memcpy(values.data(), left_.data(), values.size_bytes());
    left_ = left_.subspan(values.size_bytes());
  }
  template <class Value>
  std::vector<Value> get_list() {
    const auto size = get<std::uint64_t>();
    if (size > left_.size() / sizeof(Value)) throw std::logic_error("a message ends too early");
    std::vector<Value> values(size);
    get_all(std::span(values));
    return values;
  }
  bool empty() const { return left_.empty(); }

 private:
  std::span<const std::byte> left_;
};

/// One value of every rank.
template <class Value>
std::vector<Value> all_gather_value(Communicator& ranks, const Value& own) {
  const Gathered gathered = ranks.all_gather(ByteWriter().put(own).take());
  std::vector<Value> values;
  for (const Bytes& bytes : *gathered) values.push_back(ByteReader(bytes).get<Value>());
  return values;
}

}  // namespace catena::ranks
