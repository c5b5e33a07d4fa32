// A sphere against a vector of others.
#if defined(CATENA_CORE_BLOCKS_VECTOR_HITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_VECTOR_HITS_INL_H
#undef CATENA_CORE_BLOCKS_VECTOR_HITS_INL_H
#else
#define CATENA_CORE_BLOCKS_VECTOR_HITS_INL_H
#endif

#include <algorithm>
#include <cstdint>
#include <span>

#include "catena/core/blocks/open_pairs-inl.h"
#include "catena/core/blocks/overlap_test-inl.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/blocks/window_filter.h"
#include "catena/core/chain/chain_view.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using SphereTag = OverlapTest::Tag;
inline constexpr std::uint32_t sphere_lanes = hn::MaxLanes(SphereTag());

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

  /// Works in `room`, and adds to `open_done` how many pairs binary32 left open; `doubt` as BlockTree::doubt.
  /// All must outlive this.
  VectorHits(const ChainView& chain, std::span<Pair> room, float doubt, std::uint64_t& open_done,
             Found& found)
      : filter_(chain),
        overlap_(chain.extent, doubt),
        room_(room),
        limit_(room.size() - sphere_lanes),
        found_(found),
        open_(chain),
        open_done_(open_done) {
    if (chain.strand_count == 1) window_ = std::min(chain.reach.certain, chain.size);
    window_is_all_ = chain.exclusion.window_alone;
  }

  /// Sphere i, which may be among the others and is then not met, against all of them; of equal radii theirs
  /// are not read.
  template <bool equal_radii = false>
  HWY_INLINE void test(std::uint32_t i, const Sphere& sphere, const VectorOfSpheres& others) {
    const OverlapTest::Verdict verdict = compare<equal_radii>(sphere, others);
    store(i, hn::Set(Bits(), i - window_), hn::LoadU(Bits(), others.index),
          hn::RebindMask(Bits(), verdict.may), verdict);
  }
  /// Spheres that are told to be met by their counterparts, lane by lane, none by itself.
  HWY_INLINE void add(hn::Vec<Bits> i, hn::Vec<Bits> j, const OverlapTest::Verdict& verdict) {
    store(i, hn::Sub(i, hn::Set(Bits(), window_)), j, hn::RebindMask(Bits(), verdict.may), verdict);
  }
  const OverlapTest& overlap_test() const { return overlap_; }

  /// Hands over what is left.
  void finish() {
    decide();
    flush();
  }

 private:
  template <bool equal_radii>
  HWY_INLINE OverlapTest::Verdict compare(const Sphere& s, const VectorOfSpheres& others) const {
    const SphereTag tag;
    const auto reach =
        equal_radii ? hn::Set(tag, s.radius + s.radius) : hn::Add(others.field(3), hn::Set(tag, s.radius));
    return overlap_(hn::Sub(others.field(0), hn::Set(tag, s.x)), hn::Sub(others.field(1), hn::Set(tag, s.y)),
                    hn::Sub(others.field(2), hn::Set(tag, s.z)), reach);
  }

  /// Sphere i, or each lane of i; `first` is the first of its window.
  template <class I>
  HWY_INLINE void store(I i, hn::Vec<Bits> first, hn::Vec<Bits> j, hn::Mask<Bits> keep,
                        const OverlapTest::Verdict& verdict) {
    // |j - i| > window is one comparison of what wraps, and never true of i itself.
    keep = hn::And(keep, hn::Gt(hn::Sub(j, first), hn::Set(Bits(), 2 * window_)));
    const auto undecided = hn::AndNot(hn::RebindMask(Bits(), verdict.certain), keep);
    if (HWY_UNLIKELY(!hn::AllFalse(Bits(), undecided))) {
      open_.add(Bits(), i, j, undecided);
      keep = hn::AndNot(undecided, keep);
      if (open_.full()) decide();
    }
    hits_ += store_pairs(Bits(), i, j, keep, room_.data() + hits_);
    if (HWY_UNLIKELY(hits_ >= limit_)) flush();
  }

  HWY_NOINLINE void decide() {
    open_done_ += open_.size();
    report(open_.decide());
  }
  HWY_NOINLINE void flush() {
    report(room_.first(hits_));
    hits_ = 0;
  }
  /// Those that are no neighbours.
  void report(std::span<Pair> hits) {
    found_.collide(window_is_all_ ? hits : filter_.without_neighbours(hits));
  }

  const WindowFilter filter_;
  const OverlapTest overlap_;
  const std::span<Pair> room_;
  const std::size_t limit_;
  Found& found_;
  OpenPairs open_;
  std::uint64_t& open_done_;
  std::uint32_t window_ = 0;  // within it all are neighbours
  bool window_is_all_;        // it decides alone who is one
  std::size_t hits_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
