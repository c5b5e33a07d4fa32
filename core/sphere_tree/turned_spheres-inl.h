// The pairs of sixteen spheres.
#if defined(CATENA_CORE_SPHERE_TREE_TURNED_SPHERES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPHERE_TREE_TURNED_SPHERES_INL_H
#undef CATENA_CORE_SPHERE_TREE_TURNED_SPHERES_INL_H
#else
#define CATENA_CORE_SPHERE_TREE_TURNED_SPHERES_INL_H
#endif

#include "catena/core/blocks/vector_hits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Sixteen spheres, each field twice in a row, so that any sixteen that follow one another are the spheres
/// turned. Turned by 1 to 8 lanes they are met by all others, each pair once: by 8 only the first half
/// counts, as the other one has the same pairs. That is half of the comparisons of each sphere with all
/// behind it.
class TurnedSpheres {
 public:
  static constexpr std::uint32_t size = 16;

  /// x y z radius, sixteen numbers each; what has no x (NaN) meets nothing.
  HWY_INLINE TurnedSpheres(const float* fields, const std::uint32_t* index) {
    for (std::uint32_t k = 0; k < size; k += sphere_lanes) {
      for (std::uint32_t f = 0; f < 4; ++f) {
        const auto v = hn::LoadU(Tag(), fields + f * size + k);
        hn::StoreU(v, Tag(), field_[f] + k);
        hn::StoreU(v, Tag(), field_[f] + k + size);
      }
      const auto i = hn::LoadU(Bits(), index + k);
      hn::StoreU(i, Bits(), index_ + k);
      hn::StoreU(i, Bits(), index_ + k + size);
    }
  }

  template <class Found>
  HWY_INLINE void meet(VectorHits<Found>& hits) const {
    constexpr std::uint32_t half = size / 2;
    for (std::uint32_t k = 0; k < size; k += sphere_lanes)
      for (std::uint32_t by = 1; by <= half; ++by) {
        if (by == half && k >= half) break;
        OverlapTest::Verdict verdict = compare(k, k + by, hits.overlap_test());
        if (by == half && sphere_lanes > half) verdict.may = hn::And(verdict.may, hn::FirstN(Tag(), half));
        if (HWY_LIKELY(hn::AllFalse(Tag(), verdict.may))) continue;
        hits.add(hn::LoadU(Bits(), index_ + k), hn::LoadU(Bits(), index_ + k + by), verdict);
      }
  }

 private:
  using Tag = SphereTag;
  using Bits = hn::RebindToUnsigned<Tag>;

  HWY_INLINE hn::Vec<Tag> field(std::uint32_t f, std::uint32_t k) const {
    return hn::LoadU(Tag(), field_[f] + k);
  }
  /// Those from lane k on with those from lane j on.
  HWY_INLINE OverlapTest::Verdict compare(std::uint32_t k, std::uint32_t j,
                                          const OverlapTest& overlap) const {
    return overlap(hn::Sub(field(0, j), field(0, k)), hn::Sub(field(1, j), field(1, k)),
                   hn::Sub(field(2, j), field(2, k)), hn::Add(field(3, j), field(3, k)));
  }

  alignas(64) float field_[4][2 * size];
  alignas(64) std::uint32_t index_[2 * size];
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
