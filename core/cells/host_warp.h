#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

namespace catena {

/// So many threads in step, emulated on the host: what one instruction does in all lanes is a function of the
/// lane here, run for one lane after the other. The device's twins are DeviceWarp and DeviceQuad, in which
/// each thread runs it for its own lane; so a function may not use what it does in other lanes but through
/// these calls.
template <std::uint32_t count>
struct HostTeam {
  static constexpr std::uint32_t lanes = count;

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
  /// The bits that any lane has.
  std::uint32_t any(const Lanes<std::uint32_t>& bits) const {
    std::uint32_t all = 0;
    for (const std::uint32_t of_lane : bits.of) all |= of_lane;
    return all;
  }
  template <class F>
  bool none(const F& flag) const {
    return ballot(flag) == 0;
  }
  template <class F>
  float greatest(const F& number) const {
    float result = number(0u);
    for (std::uint32_t lane = 1; lane < lanes; ++lane) result = std::max(result, number(lane));
    return result;
  }
  template <class F>
  float sum(const F& number) const {
    float result = number(0u);
    for (std::uint32_t lane = 1; lane < lanes; ++lane) result += number(lane);
    return result;
  }
  /// What one lane has, for all.
  template <class T>
  T from(const Lanes<T>& value, std::uint32_t lane) const {
    return value[lane];
  }
  /// For each lane what another has that comes so many later, around.
  template <class T>
  Lanes<T> shifted(const Lanes<T>& value, std::uint32_t by) const {
    Lanes<T> result;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) result.of[lane] = value[(lane + by) % lanes];
    return result;
  }
};

/// As many lanes as a warp has, four, and eight.
using HostWarp = HostTeam<32>;
using HostQuad = HostTeam<4>;
using HostOctet = HostTeam<8>;

}  // namespace catena
