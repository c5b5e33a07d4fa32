#include "catena/bench/ranks/lattice_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "catena/core/executor/large_vector.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/scenes/serpentine_path.h"

namespace catena::ranks {

namespace {

/// Row by row, as one number of the cell alone changes along each: to divide for every sphere takes longer
/// than all else.
void fill(const bench::LatticeBox& box, SphereId begin, std::span<Sphere> spheres) {
  const auto radius = static_cast<float>(box.reach / 2.0);
  for (std::size_t k = 0; k < spheres.size();) {
    const SphereId row = (begin + k) / box.side;
    auto cell = serpentine_cell(begin + k, box.side);
    const auto stop =
        static_cast<std::size_t>(std::min<SphereId>(spheres.size(), (row + 1) * box.side - begin));
    for (const std::uint64_t step = row % 2 == 0 ? 1 : ~std::uint64_t{0}; k < stop; ++k, cell[0] += step) {
      const Vec3 p = serpentine_point(cell, box.side, box.face_centred);
      spheres[k] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), radius};
    }
  }
}

}  // namespace

Part lattice_part(const bench::LatticeBox& box, SphereId begin, SphereId end) {
  Part part;
  resize_large(part.spheres, end - begin);
  fill(box, begin, part.spheres);
  const SphereId strand_size = box.rods ? box.side : box.spheres();
  for (SphereId at = begin; at < end;) {
    const SphereId number = at / strand_size, stop = std::min(end, (number + 1) * strand_size);
    part.pieces.push_back({at,
                           static_cast<std::uint32_t>(at - begin),
                           static_cast<std::uint32_t>(stop - at),
                           {number * strand_size, strand_size, 0, 0, number}});
    at = stop;
  }
  return part;
}

std::string lattice_fault(Communicator& ranks, const bench::LatticeBox& box, const RankAnswer& answer,
                          bool with_pairs) {
  struct Sums {
    std::uint64_t ends, pairs;
  } sums{std::accumulate(answer.count.begin(), answer.count.end(), std::uint64_t{0}), answer.pairs.size()},
      all{0, 0};
  for (const Sums& s : all_gather_value(ranks, sums)) all.ends += s.ends, all.pairs += s.pairs;
  if (answer.pair_count != box.pairs())
    return fmt::format("{} pairs instead of {}", answer.pair_count, box.pairs());
  if (all.ends != 2 * box.pairs())
    return fmt::format("counts sum up to {} instead of {}", all.ends, 2 * box.pairs());
  if (!with_pairs) return "";
  if (all.pairs != box.pairs()) return fmt::format("{} pairs are kept of {}", all.pairs, box.pairs());
  for (const auto& [i, j] : answer.pairs)
    if (!(i < j && j < box.spheres() && box.collide(i, j)))
      return fmt::format("{} and {} do not collide", i, j);
  // Sorted, and each of the rank of its first sphere.
  return std::ranges::adjacent_find(answer.pairs) == answer.pairs.end() ? "" : "a pair is there twice";
}

}  // namespace catena::ranks
