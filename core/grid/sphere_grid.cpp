#include "catena/core/grid/sphere_grid.h"

#include <algorithm>
#include <bit>

namespace catena {
namespace {

using Part = SphereGrid::OctavePart;
constexpr std::size_t most_octaves = Part::octaves;

/// 0 for radii down to half of the greatest, and so on; does not fall as the radius does.
std::uint32_t octave(float radius, float greatest) {
  if (radius == 0) return greatest == 0 ? 0 : most_octaves - 1;
  constexpr int mantissa = 52, bias = 1023;  // the quotient of two binary32 numbers is a normal binary64 one
  const auto exponent =
      static_cast<int>(std::bit_cast<std::uint64_t>(double{radius} / greatest) >> mantissa) - bias;
  return static_cast<std::uint32_t>(std::max(0, -1 - exponent));
}

/// A counting sort that keeps the order within an octave. Until there are places, `index` keeps the octaves.
class OctaveSort {
 public:
  OctaveSort(const ChainView& chain, std::span<const std::uint32_t> only, SphereGrid& grid, const Team& team)
      : chain_(chain), only_(only), grid_(grid), team_(team), n_(grid.spheres()), parts_(grid.octave_parts) {}

  void run() {
    parts_.assign((n_ + members_of_a_part - 1) / members_of_a_part, {});
    each_part([&](Part& part, std::uint32_t k) {
      const float r = chain_.spheres[sphere(k)].radius;
      const std::uint32_t o = grid_.index[k] = octave(r, chain_.extent.greatest_radius);
      ++part.spheres[o];
      part.greatest[o] = std::max(part.greatest[o], r);
    });
    add_up();
    grid_.members.resize(n_);
    each_part(
        [&](Part& part, std::uint32_t k) { grid_.members[part.spheres[grid_.index[k]]++] = sphere(k); });
  }

 private:
  static constexpr std::uint32_t members_of_a_part = 1 << 16;

  std::uint32_t sphere(std::uint32_t k) const { return only_.empty() ? k : only_[k]; }

  template <class Body>
  void each_part(const Body& body) {
    team_.for_each_range(
        static_cast<std::uint32_t>(parts_.size()), 1, [&](std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t p = begin; p < end; ++p)
            for (std::uint32_t k = p * members_of_a_part; k < std::min(n_, (p + 1) * members_of_a_part); ++k)
              body(parts_[p], k);
        });
  }

  /// Numbers of spheres become places, and octaves that have some are told.
  void add_up() {
    std::uint32_t place = 0;
    for (std::size_t o = 0; o < most_octaves; ++o) {
      SphereGrid::Octave all{place, place, 0};
      for (Part& part : parts_) {
        const std::uint32_t spheres = part.spheres[o];
        part.spheres[o] = all.end;
        all.end += spheres;
        all.greatest = std::max(all.greatest, part.greatest[o]);
      }
      if (all.first < all.end) grid_.octaves.push_back(all);
      place = all.end;
    }
  }

  const ChainView& chain_;
  const std::span<const std::uint32_t> only_;
  SphereGrid& grid_;
  const Team& team_;
  const std::uint32_t n_;
  std::vector<Part>& parts_;
};

}  // namespace

void sort_by_octave(const ChainView& chain, std::span<const std::uint32_t> only, SphereGrid& grid,
                    const Team& team) {
  const std::uint32_t n = only.empty() ? chain.size : static_cast<std::uint32_t>(only.size());
  const float greatest = chain.extent.greatest_radius;
  const auto make_room = [n](auto& field) {
    field.resize(n + SphereGrid::margin);
    std::fill_n(field.data() + n, SphereGrid::margin, 0);  // is read, though nothing comes of it
  };
  for (auto* field : {&grid.x, &grid.y, &grid.z, &grid.radius}) make_room(*field);
  make_room(grid.index);
  grid.members.clear();
  grid.octaves.clear();
  if (n == 0) return;
  if (octave(chain.extent.least_radius, greatest) == 0) {
    grid.members.assign(only.begin(), only.end());
    grid.octaves.push_back({0, n, greatest});
    return;
  }
  OctaveSort(chain, only, grid, team).run();
}

}  // namespace catena
