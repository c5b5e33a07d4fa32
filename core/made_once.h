#pragma once
#include <mutex>
#include <optional>

namespace catena {

/// A value that is made when it is first asked for, once for all threads. Where making it throws, the next to
/// ask tries again.
template <class T>
class MadeOnce {
 public:
  template <class Make>
  const T& by(const Make& make) const {
    const std::scoped_lock lock(making_);
    if (!value_) value_.emplace(make());
    return *value_;
  }

 private:
  mutable std::mutex making_;
  mutable std::optional<T> value_;
};

}  // namespace catena
