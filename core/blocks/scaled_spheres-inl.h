// Spheres times a power of two.
#if defined(CATENA_CORE_BLOCKS_SCALED_SPHERES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SCALED_SPHERES_INL_H
#undef CATENA_CORE_BLOCKS_SCALED_SPHERES_INL_H
#else
#define CATENA_CORE_BLOCKS_SCALED_SPHERES_INL_H
#endif

#include <algorithm>
#include <span>

#include "catena/core/blocks/lanes-inl.h"
#include "catena/core/sphere.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// No number of eight spheres loses a bit times a power of two.
HWY_INLINE bool scale_exactly(const Sphere* spheres, float scale) {
  using Tag = hn::CappedTag<float, 16>;
  const auto by = hn::Set(Tag(), scale), back = hn::Set(Tag(), 1 / scale);
  auto same = hn::FirstN(Tag(), hn::MaxLanes(Tag()));
  for (std::size_t k = 0; k < 8 * sizeof(Sphere) / sizeof(float); k += hn::MaxLanes(Tag())) {
    const auto v = hn::LoadU(Tag(), &spheres->x + k);
    same = hn::And(same, hn::Eq(hn::Mul(hn::Mul(v, by), back), v));
  }
  return hn::AllTrue(Tag(), same);
}

/// Eight spheres, all numbers times a power of two. What is above 1 makes subnormal numbers normal: their
/// digits, taken as whole numbers, are multiplied, as most machines take a hundred times as long for a
/// product with a subnormal number.
HWY_INLINE void scale_spheres(const Sphere* spheres, float by, Sphere* to) {
  using Tag = hn::CappedTag<float, 16>;
  const hn::RebindToSigned<Tag> whole;
  const float* const from = reinterpret_cast<const float*>(spheres);
  for (std::size_t k = 0; k < 8 * sizeof(Sphere) / sizeof(float); k += hn::MaxLanes(Tag())) {
    const auto v = hn::LoadU(Tag(), from + k), all_by = hn::Set(Tag(), by);
    const auto digits = hn::BitCast(whole, hn::Abs(v));
    const auto tiny = hn::Lt(digits, hn::Set(whole, 0x00800000));
    auto scaled = v;
    if (by > 1 && HWY_UNLIKELY(!hn::AllFalse(whole, hn::And(tiny, hn::Ne(digits, hn::Zero(whole)))))) {
      const auto subnormal = hn::RebindMask(Tag(), tiny);  // and 0
      const auto made = hn::Mul(hn::ConvertTo(Tag(), digits), hn::Set(Tag(), by * 0x1p-149f));
      scaled =
          hn::IfThenElse(subnormal, hn::CopySign(made, v), hn::Mul(hn::IfThenZeroElse(subnormal, v), all_by));
    } else {
      scaled = hn::Mul(v, all_by);
    }
    hn::StoreU(scaled, Tag(), reinterpret_cast<float*>(to) + k);
  }
}

/// All of them; false where one would lose a bit. What grows, to below 2^20, loses none.
HWY_INLINE bool scale_spheres(std::span<const Sphere> spheres, float by, Sphere* to) {
  constexpr std::size_t at_once = 8;
  bool exact = true;
  const auto scale = [&](const Sphere* from, Sphere* eight) HWY_ATTR {
    if (by < 1) exact = exact && scale_exactly(from, by);
    scale_spheres(from, by, eight);
  };
  std::size_t k = 0;
  for (; k + at_once <= spheres.size(); k += at_once) scale(&spheres[k], to + k);
  if (k == spheres.size()) return exact;
  Sphere last[at_once] = {}, scaled[at_once];
  std::copy(spheres.begin() + static_cast<std::ptrdiff_t>(k), spheres.end(), last);
  scale(last, scaled);
  std::copy_n(scaled, spheres.size() - k, to + k);
  return exact;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
