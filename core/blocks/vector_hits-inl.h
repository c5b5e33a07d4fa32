// A sphere against a vector of others.
#if defined(CATENA_CORE_BLOCKS_VECTOR_HITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_VECTOR_HITS_INL_H
#undef CATENA_CORE_BLOCKS_VECTOR_HITS_INL_H
#else
#define CATENA_CORE_BLOCKS_VECTOR_HITS_INL_H
#endif

#include <algorithm>
#include <bit>
#include <span>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/exact_lanes-inl.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/blocks/window_filter.h"
#include "catena/core/chain/chain_view.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using SphereTag = hn::CappedTag<float, 16>;
inline constexpr std::uint32_t sphere_lanes = hn::MaxLanes(SphereTag());

struct Verdict {
  hn::Mask<SphereTag> may, certain;
};
/// Stage 1 of Robust, as sphere_pairs has it: q = |cA - cB|^2 against t = (rA + rB)^2. A NaN overlaps
/// nothing.
HWY_INLINE Verdict may_overlap(hn::Vec<SphereTag> dx, hn::Vec<SphereTag> dy, hn::Vec<SphereTag> dz,
                               hn::Vec<SphereTag> reach) {
  const SphereTag tag;
  const auto slack = hn::Set(tag, 1 + 12 * 0x1p-24f), floor = hn::Set(tag, 0x1p-120f);
  const auto q = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))), t = hn::Mul(reach, reach);
  return {hn::Le(q, hn::MulAdd(t, slack, floor)), hn::Lt(hn::MulAdd(q, slack, floor), t)};
}

/// A vector of spheres: x y z radius, each so many numbers behind the one before, and their indices. What is
/// no sphere has no x (NaN).
struct VectorOfSpheres {
  const float* fields;
  std::uint32_t stride;
  const std::uint32_t* index;
  HWY_INLINE hn::Vec<SphereTag> field(std::uint32_t f) const {
    return hn::LoadU(SphereTag(), fields + f * stride);
  }
};

/// Decides which spheres of a vector collide with one, and hands over those that are no neighbours to Found's
/// collide(pairs), each pair once, the lower index first.
template <class Found>
class VectorHits {
 public:
  using Bits = hn::RebindToUnsigned<SphereTag>;

  /// Works in `room`. All must outlive this.
  VectorHits(const ChainView& chain, std::span<Pair> room, Found& found)
      : chain_(chain), filter_(chain), room_(room), limit_(room.size() - sphere_lanes), found_(found) {
    const ExclusionView& rule = chain.exclusion;
    const bool window = rule.rule == Exclusion::Rule::index_window && rule.one_open_strand;
    window_ = window ? std::min(rule.window, chain.size) : 0;
    window_is_all_ = window && rule.extra_row == nullptr;
  }

  /// Sphere i, which may be among the others and is then not met, against all of them.
  HWY_INLINE void test(std::uint32_t i, const Sphere& sphere, const VectorOfSpheres& others) {
    const Verdict verdict = compare(sphere, others);
    store(i, sphere, others, hn::RebindMask(Bits(), verdict.may), verdict);
  }
  /// Against those whose bits are set.
  HWY_INLINE void test(std::uint32_t i, const Sphere& sphere, const VectorOfSpheres& others,
                       std::uint32_t lanes) {
    const auto some = static_cast<std::uint16_t>(lanes);
    std::uint8_t bytes[8] = {};
    std::memcpy(bytes, &some, sizeof some);
    const Verdict verdict = compare(sphere, others);
    store(i, sphere, others, hn::And(hn::RebindMask(Bits(), verdict.may), hn::LoadMaskBits(Bits(), bytes)),
          verdict);
  }

  /// Hands over what is left.
  HWY_NOINLINE void flush() {
    const std::span<Pair> hits(room_.data(), hits_);
    hits_ = 0;
    if (window_is_all_) return found_.collide(hits);
    const auto neighbours = [&](const Pair& p) { return filter_.neighbours(p); };
    found_.collide(hits.first(
        static_cast<std::size_t>(std::remove_if(hits.begin(), hits.end(), neighbours) - hits.begin())));
  }

 private:
  static HWY_INLINE Verdict compare(const Sphere& s, const VectorOfSpheres& others) {
    const SphereTag tag;
    return may_overlap(
        hn::Sub(others.field(0), hn::Set(tag, s.x)), hn::Sub(others.field(1), hn::Set(tag, s.y)),
        hn::Sub(others.field(2), hn::Set(tag, s.z)), hn::Add(others.field(3), hn::Set(tag, s.radius)));
  }

  HWY_INLINE void store(std::uint32_t i, const Sphere& sphere, const VectorOfSpheres& others,
                        hn::Mask<Bits> keep, const Verdict& verdict) {
    // |j - i| > window is one comparison of what wraps, and never true of i itself.
    const auto j = hn::LoadU(Bits(), others.index);
    keep = hn::And(keep, hn::Gt(hn::Sub(j, hn::Set(Bits(), i - window_)), hn::Set(Bits(), 2 * window_)));
    const auto undecided = hn::AndNot(hn::RebindMask(Bits(), verdict.certain), keep);
    if (HWY_UNLIKELY(!hn::AllFalse(Bits(), undecided))) keep = decide(sphere, others, keep, undecided);
    hits_ += store_pairs(Bits(), i, j, keep, room_.data() + hits_);
    if (HWY_UNLIKELY(hits_ >= limit_)) flush();
  }

  /// `keep` without those undecided that do not overlap.
  HWY_NOINLINE hn::Mask<Bits> decide(const Sphere& sphere, const VectorOfSpheres& others, hn::Mask<Bits> keep,
                                     hn::Mask<Bits> undecided) const {
    std::uint8_t open[8] = {}, kept[8] = {};
    hn::StoreMaskBits(Bits(), undecided, open);
    hn::StoreMaskBits(Bits(), keep, kept);
    SphereRows rows;
    hn::Store(others.field(0), SphereTag(), rows.x);
    hn::Store(others.field(1), SphereTag(), rows.y);
    hn::Store(others.field(2), SphereTag(), rows.z);
    hn::Store(others.field(3), SphereTag(), rows.radius);
    const std::uint32_t asked = open[0] | std::uint32_t{open[1]} << 8;
    const Told told = told_in_binary64(sphere, rows, asked);
    std::uint32_t separate = asked & ~(told.overlap | told.open);
    for (std::uint32_t bits = told.open; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(bits));
      if (!Robust::overlap(sphere, chain_.spheres[others.index[k]])) separate |= 1u << k;
    }
    kept[0] = static_cast<std::uint8_t>(kept[0] & ~separate);
    kept[1] = static_cast<std::uint8_t>(kept[1] & ~(separate >> 8));
    return hn::LoadMaskBits(Bits(), kept);
  }

  const ChainView& chain_;
  const WindowFilter filter_;
  const std::span<Pair> room_;
  const std::size_t limit_;
  Found& found_;
  std::uint32_t window_;
  bool window_is_all_;  // it decides alone who is a neighbour
  std::size_t hits_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
