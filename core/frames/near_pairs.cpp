// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/frames/near_pairs.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>
#include <cstddef>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/compress-inl.h"
#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/frames/near_pairs.h"
#include "catena/core/frames/within.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace {

using Reals = Lanes8::Tag;
using Bits = hn::RebindToUnsigned<Reals>;
using Squares = SphereLanes::Squares;
constexpr std::size_t at_once = 8, width = Lanes8::width, parts = Lanes8::parts;

/// Eight spheres side by side.
struct Eight {
  Lanes8 x, y, z, radius;
  explicit HWY_INLINE Eight(const Sphere* spheres) {
    for (std::size_t k = 0; k < parts; ++k)
      hn::LoadInterleaved4(Reals(), &spheres[k * width].x, x.part[k], y.part[k], z.part[k], radius.part[k]);
  }
};

HWY_INLINE Lanes8 square(const Eight& a, const Eight& b) {
  Lanes8 dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  return mul_add(dz, dz, mul_add(dy, dy, dx * dx));
}

/// As within(), of the square of a distance and of the room m; fused products err less.
HWY_INLINE Flags<8> fits(const Lanes8& q, const Lanes8& m) {
  return (Lanes8::all(within_least) <= m) & (m <= Lanes8::all(within_greatest)) &
         (q * Lanes8::all(within_slack) <= m * m);
}

/// Calls each(now, other) for vectors of spheres side by side while it says true, then one(now, other) for
/// the rest.
template <class Each, class One>
HWY_INLINE bool all_of(std::span<const Sphere> now, std::span<const Sphere> other, const Each& each,
                       const One& one) {
  std::size_t i = 0;
  while (i + at_once <= now.size()) {
    Flags<8> all = each(Eight(&now[i]), Eight(&other[i]));
    constexpr std::size_t step = 64 * at_once;  // without a branch; what does not hold is seen soon
    const std::size_t end = std::min(now.size(), i + step);
    for (i += at_once; i + at_once <= end; i += at_once) all = all & each(Eight(&now[i]), Eight(&other[i]));
    if (all.bits() != 0xFF) return false;
  }
  for (; i < now.size(); ++i)
    if (!one(now[i], other[i])) return false;
  return true;
}

/// Of a pair, or eight of them side by side: how far b's centre is from a's, and the sum of the radii.
struct Apart {
  float x, y, z, reach;
};
struct EightApart {
  Lanes8 square, reach;
  explicit HWY_INLINE EightApart(const Apart* pairs) {
    Lanes8 x, y, z;
    for (std::size_t k = 0; k < parts; ++k)
      hn::LoadInterleaved4(Reals(), &pairs[k * width].x, x.part[k], y.part[k], z.part[k], reach.part[k]);
    square = mul_add(z, z, mul_add(y, y, x * x));
  }
};

HWY_INLINE void set_apart(const Sphere& a, const Sphere& b, Apart& to) {
  const hn::CappedTag<float, 4> four;
  alignas(16) static constexpr float signs[] = {-0.0f, -0.0f, -0.0f, 0.0f};
  for (std::size_t k = 0; k < 4; k += hn::Lanes(four)) {
    auto minus_b = hn::Xor(hn::LoadU(four, &b.x + k), hn::Load(four, signs + k));
    hn::Store(hn::Add(hn::LoadU(four, &a.x + k), minus_b), four, &to.x + k);
  }
}

/// Calls take(k, apart, lanes) for each eight pairs from k on, of which `lanes` are heeded: set side by side
/// a good while before they are loaded as vectors, so that loads need not wait for stores.
template <class Take>
HWY_INLINE void for_each_eight(std::span<const Sphere> spheres, std::span<const Pair> pairs,
                               const Take& take) {
  constexpr std::size_t room = 128;
  alignas(64) Apart apart[room] = {};
  for (std::size_t begin = 0; begin < pairs.size(); begin += room) {
    const std::size_t size = std::min(room, pairs.size() - begin);
    const Pair* some = &pairs[begin];
    for (std::size_t k = 0; k < size; ++k) set_apart(spheres[some[k].i], spheres[some[k].j], apart[k]);
    for (std::size_t k = 0; k < size; k += at_once) take(begin + k, EightApart(apart + k), size - k);
  }
}

/// Of a sum of radii, with the skins where they are added: outweighs what is rounded here and was when each
/// sphere was found within its skin (properties/proofs/open_pairs.g).
constexpr float reach_slack = 0x1p-20f;

/// What is stored in a vector one after the other, by eight at a time. Leaves room for eight more.
template <class T>
class Growing {
 public:
  explicit Growing(LargeVector<T>& all) : all_(all) { all_.resize(all_.capacity()); }
  HWY_INLINE T* end() {
    if (HWY_UNLIKELY(size_ + 2 * at_once > all_.size())) all_.resize(2 * all_.size() + 1024);
    return all_.data() + size_;
  }
  HWY_INLINE void grow(std::size_t by) { size_ += by; }
  std::size_t size() const { return size_; }

 private:
  LargeVector<T>& all_;
  std::size_t size_ = 0;
};

/// Which of eight there are.
HWY_INLINE Flags<8> flags_of(std::uint32_t bits) {
  return Flags<8>::from([&](std::size_t k) {
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits >> (k * width))};
    return hn::LoadMaskBits(Reals(), bytes);
  });
}
HWY_INLINE Flags<8> without(const Flags<8>& all, const Flags<8>& these) {
  return Flags<8>::from([&](std::size_t k) { return hn::AndNot(these.part[k], all.part[k]); });
}
HWY_INLINE Flags<8> unlike(const Flags<8>& a, const Flags<8>& b) {
  return Flags<8>::from([&](std::size_t k) { return hn::Xor(a.part[k], b.part[k]); });
}

/// Those of eight pairs that collide. `exact` decides what these are not certain of, which is rare.
template <class Exact>
HWY_INLINE Flags<8> colliding(const EightApart& apart, const Flags<8>& heeded, const Exact& exact) {
  Squares squares{apart.square, apart.reach * apart.reach};
  auto certain = SphereLanes::overlap_for_certain(squares) & heeded;
  auto undecided = without(SphereLanes::may_overlap(squares) & heeded, certain);
  if (HWY_LIKELY(undecided.none())) return certain;
  std::uint32_t decided = 0;
  for_each_lane(undecided.bits(), [&](std::uint32_t k) { decided |= std::uint32_t{exact(k)} << k; });
  return certain | flags_of(decided);
}

/// Calls store(part, kept, before) for each vector of eight, with those of its lanes that are kept and how
/// many were kept before it; returns how many are in all.
template <class Store>
HWY_INLINE std::size_t for_kept(const Flags<8>& keep, const Store& store) {
  std::size_t before = 0;
  for (std::size_t k = 0; k < parts; ++k) {
    const Kept<Bits> kept(hn::RebindMask(Bits(), keep.part[k]));
    store(k, kept, before);
    before += kept.size();
  }
  return before;
}

}  // namespace

bool all_within_here(std::span<const Sphere> now, float skin, std::span<const Sphere> thick) {
  return all_of(
      now, thick,
      [skin](const Eight& a, const Eight& b) {
        return fits(square(a, b), b.radius - (a.radius + Lanes8::all(skin)));
      },
      [skin](const Sphere& a, const Sphere& b) { return within(thicker(a, skin), b); });
}

bool all_near_here(std::span<const Sphere> now, std::span<const Sphere> before, float skin) {
  return all_of(
      now, before,
      [skin](const Eight& a, const Eight& b) {
        Lanes8 s = Lanes8::all(skin), q = square(a, b);
        return fits(q, (b.radius + s) - a.radius) & fits(q, a.radius - (b.radius - s));
      },
      [skin](const Sphere& a, const Sphere& b) {
        return within(a, thicker(b, skin)) && within(thinner(b, skin), a);
      });
}

void part_pairs_here(std::span<const Sphere> spheres, std::span<const Pair> pairs, float skin,
                     std::span<std::uint8_t> collide, LargeVector<std::uint32_t>& changed, OpenPairs& open) {
  const Bits bits;
  Growing<std::uint32_t> changes(changed), states(open.state);
  Growing<Pair> opens(open.pairs);
  Lanes8 skins = Lanes8::all(2 * skin), slack = Lanes8::all(reach_slack);
  for_each_eight(spheres, pairs, [&](std::size_t k, const EightApart& apart, std::size_t lanes) {
    auto heeded = flags_of(lane_bits(static_cast<std::uint32_t>(lanes)));
    Lanes8 close = (apart.reach - skins) - apart.reach * slack, sum = apart.reach + skins,
           far = sum + sum * slack;
    auto settled =
        (Lanes8::all(0) <= close) & SphereLanes::overlap_for_certain(Squares{apart.square, close * close});
    auto left = without(SphereLanes::may_overlap(Squares{apart.square, far * far}) & heeded, settled);
    auto now = colliding(apart, heeded, [&](std::uint32_t lane) {
      return Robust::overlap(spheres[pairs[k + lane].i], spheres[pairs[k + lane].j]);
    });
    auto change = unlike(now, flags_of(collide[k / at_once]));
    collide[k / at_once] = static_cast<std::uint8_t>(now.bits());
    const auto number = [&](std::size_t part) {
      return count_up(bits, static_cast<std::uint32_t>(k + part * width));
    };
    std::uint32_t* const to = changes.end();
    changes.grow(for_kept(change, [&](std::size_t part, const Kept<Bits>& kept, std::size_t before) {
      hn::StoreU(kept.compress(number(part)), bits, to + before);
    }));
    Pair* const to_pairs = opens.end();
    std::uint32_t* const to_states = states.end();
    const std::size_t more =
        for_kept(left, [&](std::size_t part, const Kept<Bits>& kept, std::size_t before) {
          hn::Vec<Bits> i, j;
          hn::LoadInterleaved2(bits, &pairs.data()[k + part * width].i, i, j);
          hn::StoreInterleaved2(kept.compress(i), kept.compress(j), bits, &to_pairs[before].i);
          auto collides = hn::IfThenElseZero(hn::RebindMask(bits, now.part[part]), hn::Set(bits, 1u));
          hn::StoreU(kept.compress(hn::Or(hn::Add(number(part), number(part)), collides)), bits,
                     to_states + before);
        });
    opens.grow(more), states.grow(more);
  });
  opens.end(), states.end();
  open.size = opens.size();
  changed.resize(changes.size());
}

void compare_open_here(std::span<const Sphere> spheres, OpenPairs& open,
                       LargeVector<std::uint32_t>& changed) {
  const Bits bits;
  const auto one = hn::Set(bits, 1u);
  Growing<std::uint32_t> changes(changed);
  const std::span<const Pair> pairs(open.pairs.data(), open.size);
  for_each_eight(spheres, pairs, [&](std::size_t k, const EightApart& apart, std::size_t lanes) {
    auto heeded = flags_of(lane_bits(static_cast<std::uint32_t>(lanes)));
    auto now = colliding(apart, heeded, [&](std::uint32_t lane) {
      return Robust::overlap(spheres[pairs[k + lane].i], spheres[pairs[k + lane].j]);
    });
    std::uint32_t* const state = &open.state[k];
    const auto before = Flags<8>::from([&](std::size_t part) {
      return hn::RebindMask(Reals(), hn::TestBit(hn::LoadU(bits, state + part * width), one));
    });
    auto change = unlike(now, before) & heeded;
    std::uint32_t* const to = changes.end();
    changes.grow(for_kept(change, [&](std::size_t part, const Kept<Bits>& kept, std::size_t others) {
      const auto of = hn::LoadU(bits, state + part * width);
      hn::StoreU(kept.compress(hn::ShiftRight<1>(of)), bits, to + others);
      const auto turned = hn::IfThenElseZero(hn::RebindMask(bits, change.part[part]), one);
      hn::StoreU(hn::Xor(of, turned), bits, state + part * width);
    }));
  });
  changed.resize(changes.size());
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(all_within_here);
HWY_EXPORT(all_near_here);
HWY_EXPORT(part_pairs_here);
HWY_EXPORT(compare_open_here);

bool all_within(std::span<const Sphere> now, float skin, std::span<const Sphere> thick) {
  return HWY_DYNAMIC_DISPATCH(all_within_here)(now, skin, thick);
}
bool all_near(std::span<const Sphere> now, std::span<const Sphere> before, float skin) {
  return HWY_DYNAMIC_DISPATCH(all_near_here)(now, before, skin);
}
void part_pairs(std::span<const Sphere> spheres, std::span<const Pair> pairs, float skin,
                std::span<std::uint8_t> collide, LargeVector<std::uint32_t>& changed, OpenPairs& open) {
  HWY_DYNAMIC_DISPATCH(part_pairs_here)(spheres, pairs, skin, collide, changed, open);
}
void compare_open(std::span<const Sphere> spheres, OpenPairs& open, LargeVector<std::uint32_t>& changed) {
  HWY_DYNAMIC_DISPATCH(compare_open_here)(spheres, open, changed);
}

}  // namespace catena
#endif
