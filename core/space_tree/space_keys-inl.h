// Keys of boxes and spheres in space, sixteen at once.
#if defined(CATENA_CORE_SPACE_TREE_SPACE_KEYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPACE_TREE_SPACE_KEYS_INL_H
#undef CATENA_CORE_SPACE_TREE_SPACE_KEYS_INL_H
#else
#define CATENA_CORE_SPACE_TREE_SPACE_KEYS_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "catena/core/blocks/transpose-inl.h"
#include "catena/core/space_tree/hilbert_curve-inl.h"
#include "catena/core/space_tree/space_keys.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// A vector of numbers of 32 bits, as HilbertCurve takes it.
struct Bits32 {
  using Tag = hn::RebindToUnsigned<Lanes16::Tag>;
  hn::Vec<Tag> v;

  HWY_INLINE explicit Bits32(std::uint32_t all) : v(hn::Set(Tag(), all)) {}
  HWY_INLINE explicit Bits32(hn::Vec<Tag> bits) : v(bits) {}
  /// The uppermost bit in every place.
  HWY_INLINE Bits32 sign() const {
    const hn::RebindToSigned<Tag> with_sign;
    return Bits32(hn::BitCast(Tag(), hn::BroadcastSignBit(hn::BitCast(with_sign, v))));
  }
  friend HWY_INLINE Bits32 operator&(Bits32 a, Bits32 b) { return Bits32(hn::And(a.v, b.v)); }
  friend HWY_INLINE Bits32 operator|(Bits32 a, Bits32 b) { return Bits32(hn::Or(a.v, b.v)); }
  friend HWY_INLINE Bits32 operator^(Bits32 a, Bits32 b) { return Bits32(hn::Xor(a.v, b.v)); }
  friend HWY_INLINE Bits32 operator~(Bits32 a) { return Bits32(hn::Not(a.v)); }
  friend HWY_INLINE Bits32 operator<<(Bits32 a, int by) { return Bits32(hn::ShiftLeftSame(a.v, by)); }
  friend HWY_INLINE Bits32 operator>>(Bits32 a, int by) { return Bits32(hn::ShiftRightSame(a.v, by)); }
};

/// Middles and sizes of sixteen entries, lane = entry.
struct Middles {
  static constexpr std::uint32_t group = 16;
  Vectors at;
  Lanes16 size;

  HWY_INLINE Middles(const SpaceRows& rows, const std::uint64_t* entries) {
    const auto row = [&](std::size_t k) {
      return rows.first + static_cast<std::uint32_t>(entries[k]) * rows.stride;
    };
    Lanes16 a[4];
    transpose_rows(row, a);
    at = {a[0], a[1], a[2]};
    size = a[3];
    if (!rows.boxes) return;
    Lanes16 b[4];
    transpose_rows([&](std::size_t k) { return row(k) + 2; }, b);
    Vectors low = at, high{b[1], b[2], b[3]}, sides = high - low;
    at = low + high;
    size = max(max(sides.x, sides.y), sides.z);
  }
};

/// body(sixteen entries, how many of them there are); past the last the last one is repeated.
template <class Body>
HWY_INLINE void for_sixteen(std::span<const std::uint64_t> entries, const Body& body) {
  constexpr std::uint32_t group = Middles::group;
  std::size_t k = 0;
  for (; k + group <= entries.size(); k += group) body(entries.data() + k, group);
  if (k == entries.size()) return;
  std::uint64_t last[group];
  std::fill(std::copy(entries.begin() + static_cast<std::ptrdiff_t>(k), entries.end(), last), last + group,
            entries.back());
  body(last, static_cast<std::uint32_t>(entries.size() - k));
}

HWY_INLINE float least_lane(const Lanes16& v) {
  float lane[Middles::group];
  v.store(lane);
  return *std::min_element(lane, lane + Middles::group);
}
HWY_INLINE float greatest_lane(const Lanes16& v) {
  float lane[Middles::group];
  v.store(lane);
  return *std::max_element(lane, lane + Middles::group);
}

inline SpaceExtent extent_of_middles(const SpaceRows& rows, std::span<const std::uint64_t> entries) {
  SpaceExtent extent;
  Lanes16 infinity = Lanes16::all(CentreCorners::infinity), none = Lanes16::all(-CentreCorners::infinity);
  Vectors low{infinity, infinity, infinity}, high{none, none, none};
  Lanes16 greatest = Lanes16::all(0);
  for_sixteen(entries, [&](const std::uint64_t* some, std::uint32_t) HWY_ATTR {
    Middles m(rows, some);
    low = {min(low.x, m.at.x), min(low.y, m.at.y), min(low.z, m.at.z)};
    high = {max(high.x, m.at.x), max(high.y, m.at.y), max(high.z, m.at.z)};
    greatest = max(greatest, m.size);
  });
  extent.middles = {{least_lane(low.x), least_lane(low.y), least_lane(low.z), 0},
                    {greatest_lane(high.x), greatest_lane(high.y), greatest_lane(high.z), 0}};
  extent.greatest = greatest_lane(greatest);
  return extent;
}

/// Coordinates of cubes.
HWY_INLINE Bits32 cube(hn::Vec<Lanes16::Tag> at, float low, const SpaceGrid& grid) {
  const Lanes16::Tag tag;
  auto from_low = hn::Sub(hn::Mul(at, hn::Set(tag, grid.scale)), hn::Set(tag, low));
  auto last = hn::Set(tag, static_cast<float>((1 << SpaceGrid::bits) - 1));
  auto which = hn::Min(hn::Mul(from_low, hn::Set(tag, grid.cubes)), last);
  return Bits32(hn::BitCast(Bits32::Tag(), hn::ConvertTo(hn::RebindToSigned<Lanes16::Tag>(), which)));
}

/// By how many factors of `step` sizes are less than the greatest, the last class at most; by exponents, as
/// patterns of positive numbers rise as these do. What is subnormal is raised out of that before, unless it
/// is of the last class anyway.
HWY_INLINE Bits32 class_of(hn::Vec<Lanes16::Tag> size, float greatest) {
  static_assert(SpaceGrid::step == 8);
  constexpr int bits_of_step = 3, digits = 23;
  constexpr float raise = 0x1p23f, no_subnormal = 0x1p100f;
  const Lanes16::Tag tag;
  const hn::RebindToSigned<Lanes16::Tag> whole;
  const float times = greatest < no_subnormal ? raise : 1;
  auto apart = hn::Sub(hn::Set(whole, std::bit_cast<std::int32_t>(greatest * times) - 1),
                       hn::BitCast(whole, hn::Mul(size, hn::Set(tag, times))));
  auto octaves = hn::Max(hn::ShiftRight<digits>(apart), hn::Zero(whole));
  // A third of what is below 2^9.
  auto steps = hn::ShiftRight<9>(hn::Mul(octaves, hn::Set(whole, (1 << 9) / bits_of_step + 1)));
  return Bits32(hn::BitCast(Bits32::Tag(), hn::Min(steps, hn::Set(whole, SpaceGrid::classes - 1))));
}

inline void make_keys_of_middles(const SpaceRows& rows, const SpaceGrid& grid,
                                 std::span<std::uint64_t> entries) {
  std::uint64_t* to = entries.data();
  for_sixteen(entries, [&](const std::uint64_t* some, std::uint32_t count) HWY_ATTR {
    Middles m(rows, some);
    std::uint32_t key[Middles::group];
    std::uint64_t with_key[Middles::group];
    for (std::size_t k = 0; k < Lanes16::parts; ++k) {
      const Bits32 place = HilbertCurve::place(cube(m.at.x.part[k], grid.low[0], grid),
                                               cube(m.at.y.part[k], grid.low[1], grid),
                                               cube(m.at.z.part[k], grid.low[2], grid), SpaceGrid::bits);
      const Bits32 all = class_of(m.size.part[k], grid.greatest) << 3 * SpaceGrid::bits | place;
      hn::StoreU(all.v, Bits32::Tag(), key + k * Lanes16::width);
    }
    const hn::CappedTag<std::uint64_t, Middles::group> entry;
    const hn::Rebind<std::uint32_t, decltype(entry)> of_entry;
    auto lower = hn::Set(entry, 0xFFFFFFFFu);
    for (std::uint32_t k = 0; k < Middles::group; k += static_cast<std::uint32_t>(hn::Lanes(entry))) {
      auto upper = hn::ShiftLeft<32>(hn::PromoteTo(entry, hn::LoadU(of_entry, key + k)));
      hn::StoreU(hn::Or(upper, hn::And(hn::LoadU(entry, some + k), lower)), entry, with_key + k);
    }
    std::copy_n(with_key, count, to);
    to += count;
  });
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
