// Blocks that follow one another along the chain: the spheres of each against one another and the next one's.
#if defined(CATENA_CORE_BLOCKS_BLOCK_RUN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_BLOCK_RUN_INL_H
#undef CATENA_CORE_BLOCKS_BLOCK_RUN_INL_H
#else
#define CATENA_CORE_BLOCKS_BLOCK_RUN_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/filled-inl.h"
#include "catena/core/blocks/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Sixteen blocks along the chain, a lane each. Where most are compared with themselves and with the next,
/// one comparison here is of two spheres of each: unlike in SphereTiles no number is spread over lanes, and
/// spheres that are too near along the chain take no part.
class BlockRun {
 public:
  static constexpr std::uint32_t block = BlockTree::block, blocks = BlockTree::group;

  /// A bit for each block that is compared with itself, and for each but the last that is with the next.
  struct Asked {
    std::uint32_t inside, onward;
    std::uint32_t pairs() const {
      return static_cast<std::uint32_t>(std::popcount(inside) + std::popcount(onward));
    }
    Asked operator&(const Asked& some) const { return {inside & some.inside, onward & some.onward}; }
    Asked operator-(const Asked& some) const { return {inside & ~some.inside, onward & ~some.onward}; }
  };

  /// Of blocks of eight spheres, one after another from `spheres` on. Left out are spheres of which the
  /// second comes `window` after the first, or sooner.
  HWY_INLINE BlockRun(const Sphere* spheres, const Asked& asked, std::uint32_t window, float slack) {
    load(spheres);
    std::memset(apart_, 0xFF, sizeof apart_);
    std::memset(certain_, 0, sizeof certain_);
    Lanes16 all_slack = Lanes16::all(slack), floor = Lanes16::all(Robust::underflow_floor);
    const std::uint32_t end = asked.onward != 0 ? 2 * block : block, nearest = std::min(window, end) + 1;
    for (std::uint32_t i = 0; i < block; ++i) {
      Vectors at = at_[i];
      Lanes16 radius = radius_[i];
      for (std::uint32_t j = i + nearest; j < end; ++j) {
        Lanes16 sum = radius_[j] + radius, q = square(at_[j] - at), of = sum * sum;
        apart_[i][j] = bits(mul_add(of, all_slack, floor) < q);
        certain_[i][j] = bits(mul_add(q, all_slack, floor) < of);
      }
    }
    ask(asked);
  }

  /// Whether binary32 leaves any open.
  bool any_open() const { return any_open_; }
  /// Calls visit(i, j, lanes) where sphere i of blocks `lanes` and the one j after their first overlap.
  template <class Visit>
  HWY_INLINE void for_overlap(const Visit& visit) const {
    for_each(certain_, visit);
  }
  /// Or where that is open.
  template <class Visit>
  HWY_INLINE void for_open(const Visit& visit) const {
    for_each(open_, visit);
  }

 private:
  using Words = std::uint16_t[block][2 * block];

  HWY_INLINE void load(const Sphere* spheres) {
    for (std::uint32_t j = 0; j < block; ++j) {
      Lanes16 field[4];
      transpose(&spheres[j].x, 4 * block, field);
      constexpr float none = 0;  // after the last
      at_[j] = {field[0], field[1], field[2]}, radius_[j] = field[3];
      at_[block + j] = {shifted(field[0], none), shifted(field[1], none), shifted(field[2], none)};
      radius_[block + j] = shifted(field[3], none);
    }
  }
  static HWY_INLINE Lanes16 square(const Vectors& v) { return dot(v, v); }
  static HWY_INLINE std::uint16_t bits(const Flags<16>& flags) {
    return static_cast<std::uint16_t>(flags.bits());
  }

  /// What is said of lanes that are asked. What is neither apart nor certain is open: so is a NaN of two
  /// infinities.
  HWY_INLINE void ask(const Asked& asked) {
    std::uint16_t all_open = 0;
    for (std::uint32_t i = 0; i < block; ++i)
      for (std::uint32_t j = 0; j < 2 * block; ++j) {
        const auto lanes = static_cast<std::uint16_t>(j < block ? asked.inside : asked.onward);
        open_[i][j] = static_cast<std::uint16_t>(~(apart_[i][j] | certain_[i][j]) & lanes);
        certain_[i][j] &= lanes;
        all_open |= open_[i][j];
      }
    any_open_ = all_open != 0;
  }

  template <class Visit>
  static HWY_INLINE void for_each(const Words& words, const Visit& visit) {
    constexpr std::uint32_t at_once = 64, count = block * 2 * block;
    const std::uint16_t* const all = words[0];
    for (std::uint32_t begin = 0; begin < count; begin += at_once)
      for (std::uint64_t left = filled(all + begin); left != 0; left &= left - 1) {
        const std::uint32_t k = begin + static_cast<std::uint32_t>(std::countr_zero(left));
        visit(k / (2 * block), k % (2 * block), std::uint32_t{all[k]});
      }
  }

  Vectors at_[2 * block];  ///< [place after the first of the block]
  Lanes16 radius_[2 * block];
  Words apart_, certain_, open_;
  bool any_open_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
