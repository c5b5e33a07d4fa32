#include "catena/core/plan/row_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "catena/core/space_tree/scattered.h"
#include "catena/core/sphere_vector.h"

namespace catena {
namespace {

using namespace sphere_vector;

constexpr std::uint32_t row_size = 8;

/// Where some of a row's spheres lie, about: not a Box, which encloses for certain. That takes longer, and
/// nothing but time depends on this one.
struct RowBox {
  Four low, high;
  explicit RowBox(const Sphere* of) {
    const Four a = four(of[0]), b = four(of[row_size / 2]), c = four(of[row_size - 1]);
    const Four most = greater(greater(a, b), c), radius = Four{} + most[3];
    low = lesser(lesser(a, b), c) - radius, high = most + radius;
  }
  bool meets(const RowBox& other) const {
    const Bits apart = (low > other.high) | (other.low > high);
    return (apart[0] | apart[1] | apart[2]) == 0;
  }

 private:
  static Four lesser(Four a, Four b) { return b < a ? b : a; }
  static Four greater(Four a, Four b) { return a < b ? b : a; }
};

double along_the_axes(const Sphere& a, const Sphere& b) {
  return std::abs(double{a.x} - b.x) + std::abs(double{a.y} - b.y) + std::abs(double{a.z} - b.z);
}

}  // namespace

RowLook RowLook::at(std::span<const Sphere> spheres) {
  constexpr std::uint32_t least = 4, few = 16, most = 4;
  const auto rows = static_cast<std::uint32_t>(spheres.size() / row_size), some = rows < few ? 2u : most;
  RowLook look;
  if (rows < least) return look;
  std::uint32_t near = 0, looks = 0, taken = 0, gone = 0;
  std::array<double, 2 * most> straight;  // ascending
  const auto take = [&](std::uint32_t own) {
    const Sphere* const first = spheres.data() + own * row_size;
    double steps = 0;
    for (const std::uint32_t at : {0u, row_size / 2 - 1, row_size - 2})
      steps += along_the_axes(first[at], first[at + 1]);
    if (steps > 0) {
      const double share = 3 * along_the_axes(first[0], first[row_size - 1]) / ((row_size - 1) * steps);
      std::uint32_t at = gone++;
      for (; at > 0 && straight[at - 1] > share; --at) straight[at] = straight[at - 1];
      straight[at] = share;
    }
    const RowBox box(first);
    for (std::uint32_t apart = 2; apart < rows; apart *= 2) {
      // Those from `apart` to 2 apart - 1 away.
      const auto of = [&](std::uint32_t all) {
        return std::max(std::min(2 * apart, all + 1), apart) - apart;
      };
      const std::uint32_t before = of(own), behind = of(rows - 1 - own);
      if (before + behind == 0) break;
      const std::uint32_t one = scattered(++looks, before + behind);
      const std::uint32_t other = one < before ? own - apart - one : own + apart + (one - before);
      if (box.meets(RowBox(spheres.data() + other * row_size))) near += before + behind;
    }
    ++taken;
  };
  // Not quite at even distances, which are whole strands where numbers are round.
  const auto place = [&](std::uint32_t k) {
    return k * rows / (2 * some) + scattered(k, std::min(rows / (2 * some), 7u));
  };
  for (std::uint32_t k = 0; k < some; ++k) take(place(2 * k + 1));
  if (near > 0 && rows >= few)  // or nothing more will be found
    for (std::uint32_t k = 0; k < some; ++k) take(place(2 * k));
  look.near = static_cast<double>(near) / taken;
  // That of the middle ones: a row that jumps would outweigh all others.
  if (gone > 0) look.straight = (straight[(gone - 1) / 2] + straight[gone / 2]) / 2;
  return look;
}

}  // namespace catena
