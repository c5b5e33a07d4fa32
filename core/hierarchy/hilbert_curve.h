#pragma once
#include <array>
#include <cstdint>

namespace catena {

/// Hilbert's curve through the cubes of space: two that follow one another on it share a face, where Morton's
/// leaps, so that stretches of it are about half as wide in sum.
class HilbertCurve {
 public:
  /// The place on the curve, below 8^levels, of the cube that has this Morton code (x the highest bit of
  /// three), at most 10 levels deep. A bijection; the first half of the levels gives the first half of the
  /// place.
  static constexpr std::uint32_t place(std::uint32_t morton, int levels) {
    std::uint32_t state = 0, result = 0;
    for (int shift = 3 * (levels - 1); shift >= 0; shift -= 3) {
      const std::uint32_t step = steps[state << 3 | (morton >> shift & 7)];
      result = result << 3 | (step & 7);
      state = step >> 3;
    }
    return result;
  }

 private:
  // After Hamilton 2006: within a cube the curve enters at a corner and leaves along an axis; eight corners
  // and three axes make 24 states.
  static constexpr std::uint32_t axes = 3, corners = 8;

  static constexpr std::uint32_t turned_left(std::uint32_t bits, std::uint32_t by) {
    by %= axes;
    return (bits << by | bits >> (axes - by)) & (corners - 1);
  }
  static constexpr std::uint32_t gray(std::uint32_t place) { return place ^ place >> 1; }
  static constexpr std::uint32_t entry(std::uint32_t place) {
    return place == 0 ? 0 : gray((place - 1) & ~1u);
  }
  static constexpr std::uint32_t ones_below(std::uint32_t bits) {
    std::uint32_t ones = 0;
    for (; bits & 1; bits >>= 1) ++ones;
    return ones;
  }
  static constexpr std::uint32_t axis(std::uint32_t place) {
    return place == 0 ? 0 : ones_below(place % 2 == 0 ? place - 1 : place) % axes;
  }

  /// [state, digit of the Morton code]: the next state and the digit of the place.
  static constexpr std::array<std::uint8_t, axes * corners * corners> make_steps() {
    std::array<std::uint8_t, axes * corners * corners> all{};
    for (std::uint32_t corner = 0; corner < corners; ++corner)
      for (std::uint32_t way = 0; way < axes; ++way)
        for (std::uint32_t place = 0; place < corners; ++place) {
          const std::uint32_t digit = turned_left(gray(place), way + 1) ^ corner,
                              next_corner = corner ^ turned_left(entry(place), way + 1),
                              next_way = (way + axis(place) + 1) % axes;
          all[(corner * axes + way) << 3 | digit] =
              static_cast<std::uint8_t>((next_corner * axes + next_way) << 3 | place);
        }
    return all;
  }

  static const std::array<std::uint8_t, axes * corners * corners> steps;
};

inline constexpr std::array<std::uint8_t, 3 * 8 * 8> HilbertCurve::steps = HilbertCurve::make_steps();

}  // namespace catena
