#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <type_traits>

namespace catena {

/// A thread block, emulated on the host: what `threadIdx`, a strided loop and __syncthreads() are to a
/// kernel. Between two barriers a real block runs its threads in any order; this one runs them one after the
/// other to the end, the last thread first, so that an algorithm with a missing barrier gives a wrong tree
/// here, every time, instead of on some GPU, sometimes.
class HostGroup {
 public:
  explicit HostGroup(std::uint32_t threads) : threads_(threads) {}

  std::uint32_t threads() const { return threads_; }

  /// body(k) for every k < count, thread t taking k = t, t + threads, ... Runs at the next barrier. The body
  /// is copied and must be plain data, as a kernel's captures are.
  template <class Body>
  void parallel(std::uint32_t count, const Body& body) {
    static_assert(std::is_trivially_copyable_v<Body> && sizeof(Body) <= Loop::room);
    if (size_ == max_loops) throw std::logic_error("HostGroup: too many loops between two barriers");
    Loop& loop = loops_[size_++];
    loop.count = count;
    loop.run = [](const std::byte* data, std::uint32_t begin, std::uint32_t stride, std::uint32_t end) {
      const Body& f = *std::launder(reinterpret_cast<const Body*>(data));
      for (std::uint64_t k = begin; k < end; k += stride) f(static_cast<std::uint32_t>(k));
    };
    std::memcpy(loop.body, &body, sizeof(Body));
  }

  void barrier() {
    for (std::uint32_t thread = threads_; thread-- > 0;)
      for (std::uint32_t l = 0; l < size_; ++l)
        if (thread < loops_[l].count) loops_[l].run(loops_[l].body, thread, threads_, loops_[l].count);
    size_ = 0;
  }

 private:
  struct Loop {
    static constexpr std::size_t room = 192;
    alignas(16) std::byte body[room];
    void (*run)(const std::byte*, std::uint32_t, std::uint32_t, std::uint32_t);
    std::uint32_t count;
  };
  static constexpr std::uint32_t max_loops = 8;
  std::uint32_t threads_, size_ = 0;
  Loop loops_[max_loops];
};

}  // namespace catena
