#include "catena/bench/closed_form/lattice_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "catena/core/scenes/serpentine_path.h"

namespace catena::bench {
namespace {

/// visit(squared length, points that have another there) for every step of up to `reach` but 0. In cells no
/// step is longer than in space: the face-centred basis has eigenvalues 2, -1, -1.
template <class Visit>
void for_each_step(const LatticeBox& box, const Visit& visit) {
  const std::int64_t side = box.side, reach = box.reach, far = std::min(side - 1, reach);
  for (std::int64_t a = -far; a <= far; ++a)
    for (std::int64_t b = -far; b <= far; ++b)
      for (std::int64_t c = -far; c <= far; ++c) {
        const LatticeBox::Cell step{a, b, c};
        const std::int64_t square = box.square_of(step);
        if (square == 0 || square > reach * reach) continue;
        visit(square,
              static_cast<std::uint64_t>((side - std::abs(a)) * (side - std::abs(b)) * (side - std::abs(c))));
      }
}

/// Pairs of consecutive spheres of a strand.
std::uint64_t neighbour_pairs(const LatticeBox& box) {
  const std::uint64_t strands = box.rods ? std::uint64_t{box.side} * box.side : 1;
  return box.spheres() - strands;
}

std::int64_t square_of_one_step(const LatticeBox& box) { return box.face_centred ? 2 : 1; }

}  // namespace

std::string LatticeBox::scene() const {
  return fmt::format("serpentine:side={},reach={}{}{}", side, reach,
                     face_centred ? ",lattice=face-centred" : "", rods ? ",strands=rods" : "");
}

std::int64_t LatticeBox::square_of(const Cell& step) const {
  const auto [a, b, c] = step;
  if (!face_centred) return a * a + b * b + c * c;
  return (b + c) * (b + c) + (a + c) * (a + c) + (a + b) * (a + b);
}

std::uint64_t LatticeBox::pairs() const {
  std::uint64_t twice = 0;
  for_each_step(*this, [&](std::int64_t, std::uint64_t points) { twice += points; });
  const bool neighbours_overlap = square_of_one_step(*this) <= std::int64_t{reach} * reach;
  return twice / 2 - (neighbours_overlap ? neighbour_pairs(*this) : 0);
}

std::uint64_t LatticeBox::ties() const {
  const std::int64_t square_of_reach = std::int64_t{reach} * reach;
  std::uint64_t twice = 0;
  for_each_step(*this, [&](std::int64_t square, std::uint64_t points) {
    if (square == square_of_reach) twice += points;
  });
  return twice / 2 - (square_of_one_step(*this) == square_of_reach ? neighbour_pairs(*this) : 0);
}

std::uint64_t LatticeBox::most_collisions() const {
  std::uint64_t steps = 0;
  for_each_step(*this, [&](std::int64_t, std::uint64_t) { ++steps; });
  return square_of_one_step(*this) <= std::int64_t{reach} * reach ? steps - 2 : steps;
}

LatticeBox::Cell LatticeBox::cell(std::uint64_t sphere) const {
  const auto [a, b, c] = serpentine_cell(sphere, side);
  return {static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), static_cast<std::int64_t>(c)};
}

bool LatticeBox::neighbours(std::uint64_t i, std::uint64_t j) const {
  if (i > j) std::swap(i, j);
  return j - i == 1 && !(rods && j % side == 0);
}

bool LatticeBox::collide(std::uint64_t i, std::uint64_t j) const {
  const Cell p = cell(i), q = cell(j);
  return !neighbours(i, j) &&
         square_of({p[0] - q[0], p[1] - q[1], p[2] - q[2]}) <= std::int64_t{reach} * reach;
}

std::string fault(const LatticeBox& box, const Collisions& found, bool with_pairs) {
  if (found.pair_count != box.pairs())
    return fmt::format("{} pairs instead of {}", found.pair_count, box.pairs());
  const std::uint64_t ends = std::accumulate(found.count.begin(), found.count.end(), std::uint64_t{0});
  if (ends != 2 * box.pairs()) return fmt::format("counts sum up to {} instead of {}", ends, 2 * box.pairs());
  const std::uint64_t most = found.count.empty() ? 0 : *std::ranges::max_element(found.count);
  if (box.side > 2 * box.reach && most != box.most_collisions())
    return fmt::format("a sphere has {} collisions; the most is {}", most, box.most_collisions());
  if (!with_pairs) return "";
  for (const Pair& p : found.pairs)
    if (!(p.i < p.j && p.j < box.spheres() && box.collide(p.i, p.j)))
      return fmt::format("{} and {} do not collide", p.i, p.j);
  std::vector<Pair> sorted = found.pairs;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end()) return "a pair is there twice";
  if (sorted.size() != box.pairs()) return fmt::format("{} pairs are kept of {}", sorted.size(), box.pairs());
  return "";
}

}  // namespace catena::bench
