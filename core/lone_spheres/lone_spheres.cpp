// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/lone_spheres/lone_spheres.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>

#include "catena/core/lone_spheres/lone_spheres.h"
#include "catena/core/lone_spheres/reached_cells-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

void mark_cells_here(const ChainView& chain, const LoneCells& cells, std::uint32_t begin, std::uint32_t end,
                     LoneMap& map, bool alone) {
  constexpr std::uint32_t size = 16;
  alignas(64) std::uint32_t bits[size];
  for (std::uint32_t i = begin; i < end; i += size) {
    own_bits(chain, cells, i, end, bits);
    for (std::uint32_t k = 0; k < std::min(size, end - i); ++k) map.add(bits[k], alone);
  }
}

std::uint32_t others_here(const ChainView& chain, const LoneCells& cells, std::uint32_t begin,
                          std::uint32_t end, const LoneMap& map, std::uint32_t* to) {
  ReachedCells reached;
  std::uint32_t others = 0;
  for (std::uint32_t i = begin; i < end; i += ReachedCells::size) {
    reached.take(chain, cells, i, end);
    for (std::uint32_t k = 0; k < std::min(ReachedCells::size, end - i); ++k) {
      to[others] = i + k;
      others += reached.met(k, cells, map);
    }
  }
  return others;
}

/// Pairs of so many points, x y z one field after the other, that are no farther apart along any axis.
std::uint64_t pairs_within_here(const float* fields, std::uint32_t count, std::uint32_t stride, float far) {
  using Tag = hn::CappedTag<float, 16>;
  constexpr std::uint32_t lanes = hn::MaxLanes(Tag());
  std::uint64_t pairs = 0;
  for (std::uint32_t i = 1; i < count; ++i) {
    const auto within = [&](std::uint32_t d, std::uint32_t k) HWY_ATTR {
      const float* const of = fields + std::size_t{d} * stride;
      return hn::Le(hn::Abs(hn::Sub(hn::LoadU(Tag(), of + k), hn::Set(Tag(), of[i]))), hn::Set(Tag(), far));
    };
    for (std::uint32_t k = 0; k < i; k += lanes) {
      const auto all = hn::And(hn::And(within(0, k), within(1, k)), within(2, k));
      if (HWY_UNLIKELY(!hn::AllFalse(Tag(), all)))
        pairs += hn::CountTrue(Tag(), hn::And(all, hn::FirstN(Tag(), i - k)));
    }
  }
  return pairs;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <array>
#include <cmath>

#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/space_tree/scattered.h"

namespace catena {
namespace {

HWY_EXPORT(mark_cells_here);
HWY_EXPORT(others_here);
HWY_EXPORT(pairs_within_here);

constexpr std::uint32_t lanes = 16;

/// Of so many spheres all along the chain those that reach the cell of one of `beside` on either side.
std::uint32_t meet_beside(const ChainView& chain, const LoneCells& cells, std::uint32_t samples,
                          std::uint32_t beside) {
  const auto reaches = [&](float from, float to) {
    const float at = from * cells.cells_per_unit, cell = std::floor(to * cells.cells_per_unit);
    return std::floor(at - cells.reach) <= cell && cell <= std::floor(at + cells.reach);
  };
  std::uint32_t some = 0;
  for (std::uint32_t k = 0; k < samples; ++k) {
    const std::uint32_t first = scattered(k, chain.size - 2 * beside), i = first + beside;
    const auto near = [&](std::uint32_t j) {
      const Sphere &a = chain.spheres[i], &b = chain.spheres[j];
      return j != i && reaches(a.x, b.x) && reaches(a.y, b.y) && reaches(a.z, b.z);
    };
    std::uint32_t j = first;
    while (j <= i + beside && !near(j)) ++j;
    some += j <= i + beside;
  }
  return some;
}

bool meet(const CentreCorners& a, const CentreCorners& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// Stretches of the chain meet more others than those next to them than a tree in the chain's order bears, on
/// average; told by as many as need be to see some meet, the square root of all, and each by some spheres.
bool tangled(const ChainView& chain) {
  constexpr std::uint32_t stretch = 128, of_each = 8, fewest = 12, most = 256, next_to_it = 2;
  constexpr double others = 2.8;
  const std::uint32_t stretches = chain.size / stretch;
  const auto samples = std::clamp(static_cast<std::uint32_t>(3 * std::sqrt(double(stretches))), fewest, most);
  std::array<CentreCorners, most> boxes;
  std::array<std::uint32_t, most> which;
  std::uint32_t met = 0;
  for (std::uint32_t k = 0; k < samples; ++k) {
    which[k] = scattered(k, stretches);
    for (std::uint32_t j = 0; j < of_each; ++j)
      boxes[k].take(chain.spheres[which[k] * stretch + j * (stretch / of_each)]);
    for (std::uint32_t j = 0; j < k; ++j)
      met += meet(boxes[k], boxes[j]) &&
             std::max(which[k], which[j]) > std::min(which[k], which[j]) + next_to_it;
  }
  return 2.0 * met * stretches > others * samples * samples;
}

/// Most of some runs of eight spheres are nearly straight: blocks tell what is near them.
bool smooth(const ChainView& chain) {
  constexpr std::uint32_t runs = 8, run = 8;
  constexpr double nearly = 0.9;
  const auto distance = [&](std::uint32_t i, std::uint32_t j) {
    const Sphere &a = chain.spheres[i], &b = chain.spheres[j];
    const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
    return std::sqrt(x * x + y * y + z * z);
  };
  std::uint32_t straight = 0;
  for (std::uint32_t k = 0; k < runs; ++k) {
    const std::uint32_t first = scattered(k, chain.size - run);
    double along = 0;
    for (std::uint32_t i = first + 1; i < first + run; ++i) along += distance(i - 1, i);
    straight += distance(first, first + run - 1) > nearly * along;
  }
  return 4 * straight >= 3 * runs;
}

}  // namespace

bool LoneSpheres::pay(const ChainView& chain, const LoneCells& cells) {
  constexpr std::uint32_t few = 2048, first = 8, more = 32, beside = 4;
  constexpr double most = 0.65;  // where more are left that costs more than it saves
  if (chain.size <= few || meet_beside(chain, cells, first, 1) > most * first) return false;
  if (!tangled(chain) || smooth(chain)) return false;
  const double alone_beside = 1 - double(meet_beside(chain, cells, more, beside)) / more;
  if (1 - alone_beside > most) return false;
  // So many have about as many pairs that are near as a sphere has others; few enough, and more are looked
  // at.
  constexpr double a_few = 1.5, some = 4;
  constexpr std::uint64_t most_pairs = 6;
  if (pairs_near(chain, 1 / cells.cells_per_unit, a_few) > most_pairs) return false;
  // Where blocks meet fewer they tell what is near, as those of a smooth tube of spheres with gaps do.
  constexpr double others = 1.5;
  if (!look_.everywhere_in(chain, others)) return false;
  return 1 - alone_beside * std::exp(-met_by_each(chain, cells, some)) <= most;
}

void LoneSpheres::take_sample(const ChainView& chain, double times) {
  constexpr double most_samples = 1u << 13;
  sample_.resize(static_cast<std::size_t>(std::min(most_samples, times * std::sqrt(double(chain.size)))));
  for (std::uint32_t k = 0; k < sample_.size(); ++k) sample_[k] = chain.spheres[scattered(k, chain.size)];
}

/// Of so many times the square root of all.
std::uint64_t LoneSpheres::pairs_near(const ChainView& chain, float far, double times) {
  take_sample(chain, times);
  const auto samples = static_cast<std::uint32_t>(sample_.size()), stride = (samples + lanes) / lanes * lanes;
  fields_.assign(std::size_t{3} * stride, 0);
  for (std::uint32_t k = 0; k < samples; ++k) {
    fields_[k] = sample_[k].x, fields_[stride + k] = sample_[k].y, fields_[2 * stride + k] = sample_[k].z;
  }
  return HWY_DYNAMIC_DISPATCH(pairs_within_here)(fields_.data(), samples, stride, far);
}

/// How many other spheres, and cells that share a bit with one, each meets, by what so many times the square
/// root of all meet among one another.
double LoneSpheres::met_by_each(const ChainView& chain, const LoneCells& cells, double times) {
  constexpr double reached = 8;  // cells
  take_sample(chain, times);
  ChainView some = chain;
  some.spheres = sample_.data();
  some.size = static_cast<std::uint32_t>(sample_.size());
  constexpr std::uint32_t bits_of_a_sample = 256;
  const LoneCells wide = cells.of_bits(bits_of_a_sample * some.size);
  leave_out(some, wide, met_, Team());
  const auto by_chance = [&](const LoneCells& of, std::uint32_t n) { return reached * n / of.bits; };
  const double samples = some.size, met = -std::log1p(-std::min(0.999, met_.size() / samples));
  return (met - by_chance(wide, some.size)) * chain.size / samples + by_chance(cells, chain.size);
}

void LoneSpheres::leave_out(const ChainView& chain, const LoneCells& cells,
                            LargeVector<std::uint32_t>& others, const Team& team) {
  constexpr std::uint32_t part = 1 << 13;
  const std::uint32_t parts = (chain.size + part - 1) / part;
  const auto each_part = [&](const auto& body) {
    team.for_each_range(parts, 1, [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t p = first; p < end; ++p) body(p, p * part, std::min(chain.size, (p + 1) * part));
    });
  };
  map_.clear(cells.bits);
  const bool alone = team.size() == 1;
  each_part([&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
    HWY_DYNAMIC_DISPATCH(mark_cells_here)(chain, cells, begin, end, map_, alone);
  });
  map_.close();
  others.resize(chain.size);
  left_.resize(parts);
  each_part([&](std::uint32_t p, std::uint32_t begin, std::uint32_t end) {
    left_[p] = HWY_DYNAMIC_DISPATCH(others_here)(chain, cells, begin, end, map_, others.data() + begin);
  });
  std::uint32_t all = 0;
  for (std::uint32_t p = 0; p < parts; ++p) {
    std::copy_n(others.data() + std::size_t{p} * part, left_[p], others.data() + all);
    all += left_[p];
  }
  others.resize(all);
}

}  // namespace catena
#endif
