#pragma once
#include <cstdint>
#include <initializer_list>

namespace catena::properties {

/// Seeded random numbers for generated chains: the same bits everywhere, and free to make, as every chain has
/// its own (splitmix64; a Mersenne twister would take longer to seed than a short chain to search).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
  }
  /// Uniform in [0, n), but for a bias below 2^-32; n >= 1.
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>((bits() >> 32) * n >> 32); }
  /// Uniform in [low, high].
  int between(int low, int high) {
    return low + static_cast<int>(below(static_cast<std::uint32_t>(high - low) + 1));
  }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  /// Uniform in [0, 1), a multiple of 2^-24.
  float unit() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
  /// Uniform in [-1, 1).
  float symmetric() { return 2 * unit() - 1; }
  template <class T>
  T pick(std::initializer_list<T> choices) {
    return choices.begin()[below(static_cast<std::uint32_t>(choices.size()))];
  }

 private:
  std::uint64_t state_;
};

}  // namespace catena::properties
