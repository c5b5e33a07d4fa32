#include "catena/core/space_tree/search_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "catena/core/blocks/squares_in_range.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/scattered.h"
#include "catena/core/space_tree/mean_near.h"

namespace catena {
namespace {

using Samples = std::array<std::uint32_t, most_samples>;

/// So many are looked at, of so many spheres: each at fewer others where they are more.
std::uint32_t samples_of(std::uint32_t spheres) {
  constexpr std::uint32_t fewest = 16, apart = 256;
  return std::min(spheres, std::clamp(spheres / apart, fewest, std::uint32_t{most_samples}));
}

/// What radii spheres have, told by some of them.
class RadiusSample {
 public:
  explicit RadiusSample(const ChainView& chain) : greatest_(chain.extent.greatest_radius) {}

  void take(float radius) {
    const double share = greatest_ > 0 ? double{radius} / greatest_ : 1;
    const int below = share > 0 ? -std::ilogb(share) : last;
    Octave& of = octave_[static_cast<std::size_t>(std::clamp(below, 0, last))];
    ++of.spheres, ++all_;
    of.greatest = std::max(of.greatest, radius);
  }
  struct Told {
    float greatest;  ///< but for a few
    double smaller;  ///< share of those less than half as great
    double bits;     ///< that tell a sphere's octave, on average
  };
  Told told() const {
    constexpr std::uint32_t rare = 64;  // an octave of fewer costs next to nothing
    const auto common = [&](const Octave& of) { return rare * of.spheres > all_; };
    const auto first = std::find_if(octave_.begin(), octave_.end(), common);
    if (first == octave_.end()) return {greatest_, 0, 0};
    std::uint32_t smaller = 0;
    for (auto of = first + 1; of != octave_.end(); ++of)
      if (common(*of) && of->greatest < first->greatest / 2) smaller += of->spheres;
    double bits = 0;
    for (const Octave& of : octave_)
      if (const double share = static_cast<double>(of.spheres) / all_; share > 0)
        bits -= share * std::log2(share);
    return {first->greatest, static_cast<double>(smaller) / all_, bits};
  }

 private:
  struct Octave {
    std::uint32_t spheres = 0;
    float greatest = 0;
  };
  static constexpr int last = 63;
  const float greatest_;
  std::array<Octave, last + 1> octave_{};
  std::uint32_t all_ = 0;
};

/// Some of so many spheres of a chain are searched one by one, and these are samples of them.
SingleSpheres cheaper(const ChainView& chain, std::uint32_t spheres, std::span<const std::uint32_t> samples,
                      const RadiusSample::Told& radii, SpaceSort sort) {
  constexpr double ball = 4.0 / 3 * std::numbers::pi / 27;  // of what is told to be near, within reach
  // Looks at spheres, for each that is searched: in a crowd of few a wrong guess costs little.
  constexpr std::uint64_t looks = 2, looks_of_a_few = 16;
  const std::uint64_t all = std::min(looks * chain.size, looks_of_a_few * spheres);
  const auto parts = static_cast<std::uint32_t>(std::uint64_t{chain.size} * samples.size() / all + 1);
  const NearSpheres near = mean_near(chain, samples, radii.greatest, parts);
  const double kept = sort == SpaceSort::anew ? 0 : SingleSphereCost::kept_order_ns;
  const double in_space = SingleSphereCost::in_space(near, radii.bits, spheres) - kept,
               in_cells = SingleSphereCost::in_cells(near.in_cells, spheres),
               pairs = ball * near.by_reach / 2;
  // What has no size has no width of cells either: each other place is a cell of its own then.
  const bool one_width = radii.greatest > 0 && SingleSphereCost::one_width(near.in_cells * radii.smaller);
  const bool cells = one_width && in_cells < shallow_share(spheres) * in_space;
  // In an order of blocks, beside which this is held, vectors narrower than AVX-512's cost more.
  const double beside_blocks = wide_vectors() ? 1 : 0.8;
  const double ns = beside_blocks * (one_width ? std::min(in_cells, in_space) : in_space);
  return {cells, single_spheres_share(chain.extent) * ns, pairs, radii.greatest,
          SingleSphereCost::wide_cells(near.in_cells, spheres)};
}

/// Samples all along a chain.
std::span<const std::uint32_t> all_along(const ChainView& chain, Samples& samples) {
  const std::uint32_t count = samples_of(chain.size);
  for (std::uint32_t k = 0; k < count; ++k) samples[k] = sample_along(k, count, chain.size);
  return {samples.data(), count};
}

}  // namespace

double SingleSphereCost::in_wide_cells(double near, std::uint32_t spheres) {
  return shallow_share(spheres) * (wide_vectors() ? 20 + 5.5 * near : 28 + 7 * near);
}

double SingleSphereCost::in_narrow_cells(double near) {
  return 40 + 15 / (1 + near / 4) + near * near * (wide_vectors() ? 1 / (near + 100) : 1.45 / (near + 32));
}

double SingleSphereCost::in_space(const NearSpheres& near, double octave_bits, std::uint32_t spheres) {
  const double reach = std::sqrt(near.by_reach), beside = std::max(0.0, std::sqrt(near.in_cells) - reach - 2);
  // Of thousands, as where a tube is sampled far more finely than it is thick, each is looked at.
  const double looks = std::max(10.7 * reach, 0.18 * near.by_reach);
  return (wide_vectors() ? 1 : 1.2) * (28 + looks + 1.2 * octave_bits * beside) +
         5 * octaves_beyond_cache(spheres);
}

SingleSpheres single_spheres(const ChainView& chain, SpaceSort sort) {
  constexpr std::uint32_t apart = 128;  // of those whose radii are asked for
  Samples samples;
  const std::span<const std::uint32_t> some = all_along(chain, samples);
  RadiusSample radii(chain);
  for (std::uint32_t k = 0; k < chain.size; k += apart)
    radii.take(chain.spheres[k + scattered(k / apart + 1, std::min(apart, chain.size - k))].radius);
  return cheaper(chain, chain.size, some, radii.told(), sort);
}

bool wide_cells(const ChainView& chain) {
  if (chain.size == 0) return false;
  Samples samples;
  const std::span<const std::uint32_t> some = all_along(chain, samples);
  const NearSpheres near =
      mean_near(chain, some, chain.extent.greatest_radius, static_cast<std::uint32_t>(some.size()));
  return SingleSphereCost::wide_cells(near.in_cells, chain.size);
}

SingleSpheres single_spheres(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                             SpaceSort sort) {
  Samples samples;
  RadiusSample radii(chain);
  const std::uint32_t crowded = crowding.crowded_nodes(),
                      spheres = std::min(chain.size, crowded * BlockTree::group * BlockTree::block),
                      count = std::min(crowded, samples_of(spheres));
  std::uint32_t found = 0;
  for (std::uint32_t node = 0, seen = 0; node < crowding.nodes(); ++node) {
    if (!crowding.crowded(node)) continue;
    // Another sphere of another block of each, as radii may come by turns.
    const std::uint32_t b = tree.some_block_of(node),
                        i = tree.begin_of(b) + scattered(seen + 1, tree.size_of(b));
    radii.take(chain.spheres[i].radius);
    if (found < count && std::uint64_t{seen} * count >= std::uint64_t{found} * crowded) samples[found++] = i;
    ++seen;
  }
  return cheaper(chain, spheres, {samples.data(), found}, radii.told(), sort);
}

}  // namespace catena
