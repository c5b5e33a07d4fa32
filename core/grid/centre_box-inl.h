// The box of the centres of a chain, or of a part of one.
#if defined(CATENA_CORE_GRID_CENTRE_BOX_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_CENTRE_BOX_INL_H
#undef CATENA_CORE_GRID_CENTRE_BOX_INL_H
#else
#define CATENA_CORE_GRID_CENTRE_BOX_INL_H
#endif

#include <algorithm>
#include <mutex>

#include "catena/core/blocks/simd_targets.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/team.h"
#include "catena/core/grid/bucket_map.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE void take_in(CentreBox& box, const CentreBox& other) {
  for (std::size_t d = 0; d < 3; ++d) {
    box.low[d] = std::min(box.low[d], other.low[d]);
    box.high[d] = std::max(box.high[d], other.high[d]);
  }
}

/// Of `size` spheres from `spheres` on, at least one. Lane k of a vector, and so of the least and greatest,
/// is field k mod 4 of a sphere.
HWY_INLINE CentreBox box_of_centres(const Sphere* spheres_of, std::uint32_t size) {
  CentreBox box;
  constexpr std::size_t lanes = 16;
  using Tag = hn::CappedTag<float, lanes>;
  constexpr std::size_t width = hn::MaxLanes(Tag()), parts = lanes / width, spheres = lanes / 4;
  const auto* const fields = reinterpret_cast<const float*>(spheres_of);
  const std::uint32_t whole = size / spheres * spheres;
  float low[lanes], high[lanes];
  for (std::size_t k = 0; k < lanes; ++k) low[k] = high[k] = fields[k % 4];
  hn::Vec<Tag> least[parts], greatest[parts];
  for (std::size_t k = 0; k < parts; ++k) least[k] = greatest[k] = hn::LoadU(Tag(), low + k * width);
  for (std::uint32_t i = 0; i < whole; i += spheres)
    for (std::size_t k = 0; k < parts; ++k) {
      const auto v = hn::LoadU(Tag(), fields + std::size_t{i} * 4 + k * width);
      least[k] = hn::Min(least[k], v);
      greatest[k] = hn::Max(greatest[k], v);
    }
  for (std::size_t k = 0; k < parts; ++k) {
    hn::StoreU(least[k], Tag(), low + k * width);
    hn::StoreU(greatest[k], Tag(), high + k * width);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min({low[k], low[k + 4], low[k + 8], low[k + 12]});
    box.high[k] = std::max({high[k], high[k + 4], high[k + 8], high[k + 12]});
  }
  for (std::uint32_t i = whole; i < size; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const float v = fields[std::size_t{i} * 4 + k];
      box.low[k] = std::min(box.low[k], v);
      box.high[k] = std::max(box.high[k], v);
    }
  return box;
}

/// The box around `one` and the boxes of all ranges below n, which a team shares out; box(begin, end).
template <class Box>
inline CentreBox joined_by(const Team& team, std::uint32_t n, std::uint32_t grain, const CentreBox& one,
                           const Box& box) {
  std::mutex joining;
  CentreBox all = one;
  team.for_each_range(n, grain, [&](std::uint32_t begin, std::uint32_t end) {
    const CentreBox some = box(begin, end);
    const std::lock_guard lock(joining);
    take_in(all, some);
  });
  return all;
}

/// Of all of a chain's; zeros for no spheres.
HWY_INLINE CentreBox box_of_centres(const ChainView& chain, const Team& team) {
  if (chain.size == 0) return {};
  constexpr std::uint32_t spheres_of_a_task = 1 << 14;
  return joined_by(team, chain.size, spheres_of_a_task, box_of_centres(chain.spheres, 1),
                   [&](std::uint32_t begin, std::uint32_t end) {
                     return box_of_centres(chain.spheres + begin, end - begin);
                   });
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
