#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace catena {

/// A warp, emulated on the host: what one instruction does in 32 lanes is a function of the lane here, run
/// for one lane after the other. The device's twin is DeviceWarp, in which each thread runs it for its own
/// lane; so a function may not use what it does in other lanes but through these calls.
struct HostWarp {
  static constexpr std::uint32_t lanes = 32;

  /// A value a lane.
  template <class T>
  struct Lanes {
    std::array<T, lanes> of;
    const T& operator[](std::uint32_t lane) const { return of[lane]; }
  };

  template <class F>
  auto each(const F& value) const {
    Lanes<decltype(value(0u))> result;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) result.of[lane] = value(lane);
    return result;
  }
  template <class F>
  void run(const F& body) const {
    for (std::uint32_t lane = 0; lane < lanes; ++lane) body(lane);
  }
  /// By one lane alone.
  template <class F>
  void once(const F& body) const {
    body();
  }
  /// Bit k: the flag of lane k.
  template <class F>
  std::uint32_t ballot(const F& flag) const {
    std::uint32_t bits = 0;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) bits |= static_cast<std::uint32_t>(flag(lane)) << lane;
    return bits;
  }
  /// Of numbers >= 0 (-0, too), by the order of their bits.
  template <class F>
  float greatest(const F& number) const {
    std::uint32_t bits = 0;
    for (std::uint32_t lane = 0; lane < lanes; ++lane)
      bits = std::max(bits, std::bit_cast<std::uint32_t>(std::fabs(number(lane))));
    return std::bit_cast<float>(bits);
  }
  /// What one lane has, for all.
  template <class T>
  T from(const Lanes<T>& value, std::uint32_t lane) const {
    return value[lane];
  }
  /// Each lane gets the value of the one `steps` < 32 further on, of `own` and then of `next`.
  Lanes<float> ahead(const Lanes<float>& own, const Lanes<float>& next, std::uint32_t steps) const {
    return each([&](std::uint32_t lane) {
      return lane + steps < lanes ? own[lane + steps] : next[lane + steps - lanes];
    });
  }
};

}  // namespace catena
