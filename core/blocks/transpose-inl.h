// Rows of memory to lanes.
#if defined(CATENA_CORE_BLOCKS_TRANSPOSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_TRANSPOSE_INL_H
#undef CATENA_CORE_BLOCKS_TRANSPOSE_INL_H
#else
#define CATENA_CORE_BLOCKS_TRANSPOSE_INL_H
#endif

#include "catena/core/blocks/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR  // which has no vectors to shuffle
/// Four floats each of as many rows as a vector has quads: row(first), row(first + step) and so on.
template <class Tag, class Row>
HWY_INLINE hn::Vec<Tag> quads(Tag tag, const Row& row, std::size_t first, std::size_t step) {
  if constexpr (hn::MaxLanes(Tag()) == 4) {
    return hn::LoadU(tag, row(first));
  } else {
    const hn::Half<Tag> half;
    constexpr std::size_t quads_of_half = hn::MaxLanes(half) / 4;
    return hn::Combine(tag, quads(half, row, first + quads_of_half * step, step),
                       quads(half, row, first, step));
  }
}
#endif

/// Lane k of to[c] becomes row(k)[c], for four columns c of sixteen rows k; row(k) points at four floats.
template <class Row>
HWY_INLINE void transpose_rows(const Row& row, Lanes16 (&to)[4]) {
  using Tag = Lanes16::Tag;
  for (std::size_t k = 0; k < Lanes16::parts; ++k) {
    const std::size_t first = k * Lanes16::width;
#if HWY_TARGET == HWY_SCALAR
    for (std::size_t c = 0; c < 4; ++c) to[c].part[k] = hn::Set(Tag(), row(first)[c]);
#else
    // Quad q of `a` is row 4 q of this part, of `b` row 4 q + 1, and so on; then four by four transposed.
    const hn::Repartition<double, Tag> two;
    auto a = quads(Tag(), row, first, 4), b = quads(Tag(), row, first + 1, 4);
    auto c = quads(Tag(), row, first + 2, 4), d = quads(Tag(), row, first + 3, 4);
    auto lower_ab = hn::BitCast(two, hn::InterleaveLower(Tag(), a, b));
    auto lower_cd = hn::BitCast(two, hn::InterleaveLower(Tag(), c, d));
    auto upper_ab = hn::BitCast(two, hn::InterleaveUpper(Tag(), a, b));
    auto upper_cd = hn::BitCast(two, hn::InterleaveUpper(Tag(), c, d));
    to[0].part[k] = hn::BitCast(Tag(), hn::InterleaveLower(two, lower_ab, lower_cd));
    to[1].part[k] = hn::BitCast(Tag(), hn::InterleaveUpper(two, lower_ab, lower_cd));
    to[2].part[k] = hn::BitCast(Tag(), hn::InterleaveLower(two, upper_ab, upper_cd));
    to[3].part[k] = hn::BitCast(Tag(), hn::InterleaveUpper(two, upper_ab, upper_cd));
#endif
  }
}

/// The same of rows `stride` floats apart.
HWY_INLINE void transpose(const float* first, std::size_t stride, Lanes16 (&to)[4]) {
  transpose_rows([=](std::size_t k) { return first + k * stride; }, to);
}

/// Lane k of the result is lane k + 1 of `a`; the last is `after`.
HWY_INLINE Lanes16 shifted(const Lanes16& a, float after) {
  using Tag = Lanes16::Tag;
#if HWY_TARGET == HWY_SCALAR
  return Lanes16::from(
      [&](std::size_t k) { return k + 1 < Lanes16::parts ? a.part[k + 1] : hn::Set(Tag(), after); });
#else
  constexpr std::size_t width = Lanes16::width;
  alignas(64) std::int32_t next[width];
  for (std::size_t k = 0; k < width; ++k) next[k] = static_cast<std::int32_t>((k + 1) % width);
  auto order = hn::SetTableIndices(Tag(), next);
  auto all_but_last = hn::FirstN(Tag(), width - 1);
  Lanes16 turned = Lanes16::from([&](std::size_t k) { return hn::TableLookupLanes(a.part[k], order); });
  return Lanes16::from([&](std::size_t k) {
    return hn::IfThenElse(all_but_last, turned.part[k],
                          k + 1 < Lanes16::parts ? turned.part[k + 1] : hn::Set(Tag(), after));
  });
#endif
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
