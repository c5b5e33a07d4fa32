// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/space_tree/crowd_look.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/blocks/neighbour_blocks.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/flushed_floats.h"
#include "catena/core/scattered.h"
#include "catena/core/space_tree/crowd_look.h"
#include "catena/core/space_tree/cut_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace {

constexpr std::uint32_t group = BlockTree::group, block = BlockTree::block, parts = 4,
                        lanes_of_part = group / parts;

/// Groups of sixteen blocks that lie all along the chain.
class SampleBlocks {
 public:
  SampleBlocks(const ChainView& chain, float* capsules)
      : chain_(chain), capsules_(capsules), scale_(Lanes16::all(block_scale(chain.extent))) {}

  /// Makes group g; the lanes of blocks that the chain jumps in.
  HWY_NOINLINE std::uint32_t make(std::uint32_t g) const {
    Sphere copy[group * block];
    for (std::uint32_t k = 0; k < group; ++k) {
      const Sphere* const from = chain_.spheres + first(g, k);
      std::copy(from, from + block, copy + k * block);
    }
    BlockSpheres spheres;
    load(copy, scale_, spheres);
    Lanes16 reach;
    capsules_around(spheres, reach).store(of(g));
    return BlockSteps(spheres).broken();
  }
  float* of(std::uint32_t g) const { return capsules_ + std::size_t{g} * group * Capsules::fields; }

  /// Of block k of group g, which is of one strand where that is long enough. No two lie side by side, and
  /// those of a group at no even distances, which may be a period of the chain's.
  std::uint32_t first(std::uint32_t g, std::uint32_t k) const {
    const std::uint32_t part = chain_.size / group, room = part - 2 * block,
                        i = part * k + (scattered(g + 1, room) + scattered(k, room)) % room;
    if (chain_.strand_count == 1) return i;
    const std::uint32_t strand = chain_.exclusion.strand_of[i], *const ends = chain_.exclusion.strand_first;
    return ends[strand + 1] - ends[strand] < block ? i : std::min(i, ends[strand + 1] - block);
  }

 private:
  const ChainView& chain_;
  float* const capsules_;
  const Lanes16 scale_;
};

/// Which blocks of a sample meet, by the parts of the chain that they are of.
class Meetings {
 public:
  /// `times`: memory for a number a block of the sample, which are 0.
  Meetings(const ChainView& chain, double others, double deviations, std::span<std::uint32_t> times)
      : neighbours_(chain), share_(others / (chain.size / block)), deviations_(deviations), times_(times) {}

  /// The blocks of group g in `whole`, with those of earlier groups, and with one another.
  void add(const SampleBlocks& sample, std::uint32_t g, std::uint32_t whole,
           std::span<const std::uint16_t> before) {
    for_each_lane(whole, [&](std::uint32_t i) HWY_ATTR {
      Capsules one = Capsules::all(sample.of(g), i);
      const auto meet = [&](std::uint32_t h, std::uint32_t lanes) HWY_ATTR {
        std::uint32_t met = may_collide(one, Capsules::load(sample.of(h))) & lanes;
        if (neighbours_.some())
          for_each_lane(met, [&](std::uint32_t j) {
            const auto [a, b] = std::minmax({sample.first(g, i), sample.first(h, j)});
            if (neighbours_.all(a, b + block - 1)) met &= ~(1u << j);
          });
        if (met == 0) return;
        const auto all = static_cast<std::uint32_t>(std::popcount(met));
        met_[i / lanes_of_part] += all;
        count(g * group + i, all);
        for_each_lane(met, [&](std::uint32_t j) {
          ++met_[j / lanes_of_part];
          count(h * group + j, 1);
        });
      };
      for (std::uint32_t h = 0; h < g; ++h) meet(h, before[h]);
      meet(g, whole & ~((2u << i) - 1));
      ++of_[i / lanes_of_part], ++all_;
    });
  }
  /// So many of a part meet any, if each block meets as many others as is asked.
  double expected(std::uint32_t part) const { return share_ * of_[part] * all_; }
  /// What one block meets more often than any other is chance: a great ball is near all.
  bool enough() const {
    constexpr double for_sure = 8;
    for (std::uint32_t k = 0; k < parts; ++k)
      if (met_[k] < std::max(for_sure, expected(k)) + (most_ - second_)) return false;
    return true;
  }
  /// Those of some part, or of all together, do not meet so many.
  bool few() const {
    double most = 0;
    std::uint32_t met = 0;
    for (std::uint32_t k = 0; k < parts; ++k) {
      if (fewer(met_[k], expected(k))) return true;
      most += expected(k), met += met_[k];
    }
    return fewer(met, most);
  }

 private:
  bool fewer(std::uint32_t met, double expected) const {
    return met + deviations_ * std::sqrt(expected) < expected;
  }
  void count(std::uint32_t of_sample, std::uint32_t more) {
    const std::uint32_t times = times_[of_sample] += more;
    if (of_sample != of_most_ && times > most_) second_ = most_, of_most_ = of_sample;
    if (of_sample == of_most_)
      most_ = times;
    else
      second_ = std::max(second_, times);
  }

  const NeighbourStretches neighbours_;
  const double share_, deviations_;
  std::array<std::uint32_t, parts> met_{}, of_{};
  std::uint32_t all_ = 0;
  const std::span<std::uint32_t> times_;                 ///< that a block of the sample met another
  std::uint32_t of_most_ = ~0u, most_ = 0, second_ = 0;  ///< greatest of these
};

}  // namespace

/// Where it is `jumping` only if most blocks jump.
bool crowded_everywhere_here(const ChainView& chain, double others, double deviations, bool jumping,
                             std::vector<float>& capsules, std::vector<std::uint32_t>& times) {
  constexpr std::uint32_t most_groups = 1u << 12;
  const std::uint32_t blocks = chain.size / block;
  // Of these each part meets others about as often as each block is to meet some.
  const auto groups =
      std::min(most_groups, static_cast<std::uint32_t>(2 * std::sqrt(double(blocks))) / group + 1);
  capsules.resize(std::size_t{groups} * group * Capsules::fields);
  std::array<std::uint16_t, most_groups> whole;
  const SampleBlocks sample(chain, capsules.data());
  times.assign(std::size_t{groups} * group, 0);
  Meetings meetings(chain, others, deviations, times);
  // Where the chain jumps here and there, what it jumps over tells nothing; where it does all along, all
  // does.
  const std::uint32_t broken = sample.make(0);
  const bool all_along = 2 * std::popcount(broken) > int{group};
  if (jumping && !all_along) return false;
  const std::uint32_t passed_over = all_along ? 0 : 0xFFFF;
  for (std::uint32_t g = 0; g < groups; ++g) {
    whole[g] = static_cast<std::uint16_t>(~((g == 0 ? broken : sample.make(g)) & passed_over));
    meetings.add(sample, g, whole[g], {whole.data(), g});
    if (meetings.enough()) return true;
    if (meetings.few()) return false;
  }
  return false;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(crowded_everywhere_here);

bool CrowdLook::everywhere(const ChainView& chain, double others, double deviations) {
  constexpr double empty = 1e-3;
  // Of a box that is empty but for so much a chain cannot fill every part, unless it jumps all along.
  const double width = 2.0 * chain.extent.greatest_radius, side = chain.extent.sides / 3 + width;
  const bool jumping = chain.size * width * width * width < empty * side * side * side;
  constexpr std::uint32_t few = 2048;
  if (chain.size <= few) return false;
  const FlushedFloats floats;  // squares of unlike radii are subnormal
  return HWY_DYNAMIC_DISPATCH(crowded_everywhere_here)(chain, others, deviations, jumping, capsules_, times_);
}

}  // namespace catena
#endif
