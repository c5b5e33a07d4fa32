#include "catena/core/frames/frame_difference.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace catena {
namespace {

constexpr std::size_t step = 16;  ///< spheres that are compared at once

bool same_bits(const Sphere* a, const Sphere* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(Sphere)) == 0;
}

/// The same of so many spheres at the compile time's length, which becomes a handful of vector instructions.
bool same_step(const Sphere* a, const Sphere* b) {
  std::uint64_t x[2 * step], y[2 * step], difference = 0;
  std::memcpy(x, a, sizeof x);
  std::memcpy(y, b, sizeof y);
  for (std::size_t k = 0; k < 2 * step; ++k) difference |= x[k] ^ y[k];
  return difference == 0;
}

bool is_shift(std::span<const Sphere> before, std::span<const Sphere> now, std::int64_t s) {
  const auto by = static_cast<std::size_t>(s < 0 ? -s : s);
  if (s == 0 || by >= now.size()) return false;
  return s > 0 ? same_bits(before.data() + by, now.data(), now.size() - by)
               : same_bits(before.data(), now.data() + by, now.size() - by);
}

/// The places 1, ..., most of `row` where it goes on like `start` for a few spheres, until `check` takes one.
template <class Check>
std::optional<std::int64_t> find_start(std::span<const Sphere> row, std::span<const Sphere> start,
                                       std::size_t most, const Check& check) {
  constexpr int most_checks = 4;  // a chain that repeats itself is not worth more
  int checks = 0;
  for (std::size_t s = 1; s <= most && s < row.size() && checks < most_checks; ++s) {
    if (row[s].x != start[0].x || !same_bits(&row[s], &start[0], std::min(step, row.size() - s))) continue;
    ++checks;
    if (check(static_cast<std::int64_t>(s))) return static_cast<std::int64_t>(s);
  }
  return std::nullopt;
}

}  // namespace

bool differing(std::span<const Sphere> before, std::span<const Sphere> now, std::uint32_t most,
               std::vector<SphereRange>& ranges) {
  ranges.clear();
  std::size_t spheres = 0;
  for (std::size_t begin = 0; begin < now.size(); begin += step) {
    const std::size_t end = std::min(begin + step, now.size());
    if (end - begin == step ? same_step(&before[begin], &now[begin])
                            : same_bits(&before[begin], &now[begin], end - begin))
      continue;
    spheres += end - begin;
    if (spheres > most) return false;
    if (!ranges.empty() && ranges.back().end == begin) {
      ranges.back().end = static_cast<std::uint32_t>(end);
    } else {
      if (ranges.size() == ranges.capacity()) return false;
      ranges.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
    }
  }
  return true;
}

double share_that_differs(std::span<const Sphere> before, std::span<const Sphere> now) {
  constexpr std::size_t samples = 61;  // a prime: no period of the chain hides what moves
  if (now.empty()) return 0;
  std::size_t differ = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t i = k * (now.size() - 1) / (samples - 1);
    differ += !same_bits(&before[i], &now[i], 1);
  }
  return static_cast<double>(differ) / samples;
}

std::optional<std::int64_t> shift_between(std::span<const Sphere> before, std::span<const Sphere> now,
                                          std::uint32_t most, std::int64_t guess) {
  if (now.empty()) return std::nullopt;
  if (is_shift(before, now, guess)) return guess;
  if (const auto s =
          find_start(before, now, most, [&](std::int64_t by) { return is_shift(before, now, by); }))
    return s;
  const auto back =
      find_start(now, before, most, [&](std::int64_t by) { return is_shift(before, now, -by); });
  return back ? std::optional(-*back) : std::nullopt;
}

}  // namespace catena
