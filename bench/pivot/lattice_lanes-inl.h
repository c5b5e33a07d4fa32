// Boxes and moves of the lattice in eight lanes, see WalkTree::Lanes. Compiled once a target: no include
// guard but Highway's.
#if defined(CATENA_BENCH_PIVOT_LATTICE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_BENCH_PIVOT_LATTICE_LANES_INL_H
#undef CATENA_BENCH_PIVOT_LATTICE_LANES_INL_H
#else
#define CATENA_BENCH_PIVOT_LATTICE_LANES_INL_H
#endif

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "catena/bench/pivot/walk_tree.h"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::bench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A box, or a point as the box about it alone.
struct LatticeLanes {
#if HWY_MAX_BYTES >= 32
  using Tag = hn::FixedTag<std::int32_t, 8>;
  hn::Vec<Tag> v;

  static HWY_INLINE LatticeLanes load(const WalkTree::Lanes& from) { return {hn::LoadU(Tag(), from.data())}; }
  HWY_INLINE void store(WalkTree::Lanes& to) const { hn::StoreU(v, Tag(), to.data()); }
  static HWY_INLINE LatticeLanes point(const WalkTree::NearPoint& p) {
    std::uint32_t bytes;
    std::memcpy(&bytes, &p, sizeof bytes);
    const hn::Rebind<std::int8_t, Tag> narrow;
    const auto twice = hn::BitCast(narrow, hn::Set(hn::FixedTag<std::uint32_t, 2>(), bytes));
    return LatticeLanes{hn::PromoteTo(Tag(), twice)}.negated_high();
  }
  static HWY_INLINE LatticeLanes earlier_end(const WalkTree::Halves& halves) {
    alignas(32) static constexpr std::int32_t of_earlier[8] = {3, 7, 0, 0, 3, 7, 0, 0};
    alignas(32) static constexpr std::int32_t of_later[8] = {0, 0, 3, 0, 0, 0, 3, 0};
    alignas(32) static constexpr std::int32_t third[8] = {0, 0, -1, 0, 0, 0, -1, 0};
    const Tag tag;
    const auto xy = hn::TableLookupLanes(load(halves.earlier).v, hn::SetTableIndices(tag, of_earlier));
    const auto z = hn::TableLookupLanes(load(halves.later).v, hn::SetTableIndices(tag, of_later));
    return LatticeLanes{hn::IfThenElse(hn::MaskFromVec(hn::Load(tag, third)), z, xy)}.negated_high();
  }
  friend HWY_INLINE LatticeLanes operator+(LatticeLanes a, LatticeLanes b) { return {hn::Add(a.v, b.v)}; }
  friend HWY_INLINE LatticeLanes operator-(LatticeLanes a, LatticeLanes b) { return {hn::Sub(a.v, b.v)}; }
  friend HWY_INLINE LatticeLanes join(LatticeLanes a, LatticeLanes b) { return {hn::Min(a.v, b.v)}; }
  friend HWY_INLINE bool apart(LatticeLanes a, LatticeLanes b) {
    const auto sum = hn::Add(a.v, hn::ConcatLowerUpper(Tag(), b.v, b.v));
    return (bits(hn::Gt(sum, hn::Zero(Tag()))) & no_spare) != 0;
  }
  HWY_INLINE LatticeLanes turned(LatticeSymmetry turn) const {
    return {hn::TableLookupLanes(v, hn::SetTableIndices(Tag(), turn.lanes()))};
  }

  static constexpr unsigned no_spare = 0x77;
  static HWY_INLINE unsigned bits(hn::Mask<Tag> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask, bytes);
    return bytes[0];
  }
  HWY_INLINE LatticeLanes negated_high() const { return {hn::ConcatUpperLower(Tag(), hn::Neg(v), v)}; }
#else
  WalkTree::Lanes v;

  static LatticeLanes load(const WalkTree::Lanes& from) { return {from}; }
  void store(WalkTree::Lanes& to) const { to = v; }
  static LatticeLanes point(const LatticePoint& p) { return {{p.x, p.y, p.z, 0, -p.x, -p.y, -p.z, 0}}; }
  static LatticeLanes point(const WalkTree::NearPoint& p) { return point(LatticePoint{p.x, p.y, p.z}); }
  static LatticeLanes earlier_end(const WalkTree::Halves& halves) { return point(halves.earlier_end()); }
  template <class F>
  static LatticeLanes from(F of) {
    LatticeLanes result;
    for (std::size_t k = 0; k < 8; ++k) result.v[k] = of(k);
    return result;
  }
  friend LatticeLanes operator+(const LatticeLanes& a, const LatticeLanes& b) {
    return from([&](std::size_t k) { return a.v[k] + b.v[k]; });
  }
  friend LatticeLanes operator-(const LatticeLanes& a, const LatticeLanes& b) {
    return from([&](std::size_t k) { return a.v[k] - b.v[k]; });
  }
  friend LatticeLanes join(const LatticeLanes& a, const LatticeLanes& b) {
    return from([&](std::size_t k) { return std::min(a.v[k], b.v[k]); });
  }
  friend bool apart(const LatticeLanes& a, const LatticeLanes& b) {
    int apart = 0;
    for (std::size_t k : {0, 1, 2, 4, 5, 6}) apart |= a.v[k] + b.v[k ^ 4] > 0;
    return apart;
  }
  LatticeLanes turned(LatticeSymmetry turn) const {
    return from([&](std::size_t k) { return v[static_cast<std::size_t>(turn.lanes()[k])]; });
  }
#endif
  static HWY_INLINE LatticeLanes point_of(const LatticePoint& p) {
    return load({p.x, p.y, p.z, 0, -p.x, -p.y, -p.z, 0});
  }
  HWY_INLINE LatticePoint low() const {
    WalkTree::Lanes lanes;
    store(lanes);
    return {lanes[0], lanes[1], lanes[2]};
  }
};

/// A symmetry, then a move by whole steps.
struct LatticeLanesMove {
  LatticeSymmetry turn;
  LatticeLanes shift;

  HWY_INLINE LatticeLanes operator()(const LatticeLanes& box) const { return box.turned(turn) + shift; }
  HWY_INLINE LatticeLanesMove after(const LatticeLanesMove& first) const {
    return {turn.after(first.turn), (*this)(first.shift)};
  }
};

}  // namespace catena::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
