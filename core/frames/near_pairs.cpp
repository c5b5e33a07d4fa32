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
  const Lanes8 dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
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

/// Pairs with their spheres, copied side by side a good while before they are loaded as vectors, so that
/// loads need not wait for stores: take(pairs, a, b, lanes) for each eight of them, of which `lanes` are
/// heeded.
template <class Take>
HWY_INLINE void for_each_eight(std::span<const Sphere> spheres, std::span<const Pair> pairs,
                               const Take& take) {
  constexpr std::size_t room = 256;
  alignas(64) Sphere a[room] = {}, b[room] = {};
  Pair rest[room] = {};
  for (std::size_t begin = 0; begin < pairs.size(); begin += room) {
    const std::size_t size = std::min(room, pairs.size() - begin);
    const Pair* some = &pairs[begin];
    for (std::size_t k = 0; k < size; ++k) a[k] = spheres[some[k].i], b[k] = spheres[some[k].j];
    if (size < room) some = std::copy(some, some + size, rest) - size;  // eight of which may be read
    for (std::size_t k = 0; k < size; k += at_once) take(some + k, Eight(a + k), Eight(b + k), size - k);
  }
}

/// Stores the pairs that are kept at `to`, side by side; returns their number. May write eight of them.
HWY_INLINE std::size_t store_kept(const Pair* pairs, const Flags<8>& keep, std::size_t lanes, Pair* to) {
  const Bits bits;
  std::size_t size = 0;
  for (std::size_t k = 0; k < parts && k * width < lanes; ++k) {
    auto wanted = hn::RebindMask(bits, keep.part[k]);
    if (HWY_UNLIKELY(lanes < (k + 1) * width)) wanted = hn::And(wanted, hn::FirstN(bits, lanes - k * width));
    const Kept<Bits> kept(wanted);
    hn::Vec<Bits> i, j;
    hn::LoadInterleaved2(bits, &pairs[k * width].i, i, j);
    hn::StoreInterleaved2(kept.compress(i), kept.compress(j), bits, &to[size].i);
    size += kept.size();
  }
  return size;
}

/// The first that are not of the second.
HWY_INLINE Flags<8> without(const Flags<8>& all, const Flags<8>& these) {
  return Flags<8>::from([&](std::size_t k) { return hn::AndNot(these.part[k], all.part[k]); });
}

/// The first pairs of a vector and what is stored behind them, where what was there need not be cleared.
class Growing {
 public:
  Growing(std::vector<Pair>& pairs, std::size_t keep) : pairs_(pairs), size_(keep) {}
  ~Growing() { pairs_.resize(size_); }
  Pair* end() {
    if (size_ + 2 * at_once > pairs_.size()) pairs_.resize(2 * pairs_.size() + 1024);
    return pairs_.data() + size_;
  }
  void grow(std::size_t by) { size_ += by; }

 private:
  std::vector<Pair>& pairs_;
  std::size_t size_;
};

}  // namespace

bool all_within_here(std::span<const Sphere> now, std::span<const Sphere> thick) {
  return all_of(
      now, thick, [](const Eight& a, const Eight& b) { return fits(square(a, b), b.radius - a.radius); },
      [](const Sphere& a, const Sphere& b) { return within(a, b); });
}

bool all_near_here(std::span<const Sphere> now, std::span<const Sphere> before, float skin) {
  return all_of(
      now, before,
      [skin](const Eight& a, const Eight& b) {
        const Lanes8 s = Lanes8::all(skin), q = square(a, b);
        return fits(q, (b.radius + s) - a.radius) & fits(q, a.radius - (b.radius - s));
      },
      [skin](const Sphere& a, const Sphere& b) {
        return within(a, thicker(b, skin)) && within(thinner(b, skin), a);
      });
}

void part_pairs_here(std::span<const Sphere> spheres, std::span<const Pair> pairs, float skin,
                     std::vector<Pair>& collide, std::vector<Pair>& open) {
  Growing sure(collide, 0), unsure(open, 0);
  for_each_eight(spheres, pairs, [&](const Pair* some, const Eight& a, const Eight& b, std::size_t lanes) {
    const Lanes8 s = Lanes8::all(skin), q = square(a, b), zero = Lanes8::all(0);
    const Lanes8 thin_a = a.radius - s, thin_b = b.radius - s, close = thin_a + thin_b;
    const Lanes8 far = (a.radius + s) + (b.radius + s);
    const auto certain =
        (zero <= thin_a) & (zero <= thin_b) & SphereLanes::overlap_for_certain(Squares{q, close * close});
    sure.grow(store_kept(some, certain, lanes, sure.end()));
    const auto may = SphereLanes::may_overlap(Squares{q, far * far});
    unsure.grow(store_kept(some, without(may, certain), lanes, unsure.end()));
  });
}

void find_colliding_here(std::span<const Sphere> spheres, std::span<const Pair> pairs, std::size_t keep,
                         std::vector<Pair>& found) {
  std::vector<Pair> open;  // rare, and so without memory as a rule
  {
    Growing growing(found, keep);
    for_each_eight(spheres, pairs, [&](const Pair* some, const Eight& a, const Eight& b, std::size_t lanes) {
      const Lanes8 reach = a.radius + b.radius;
      const Squares squares{square(a, b), reach * reach};
      const auto certain = SphereLanes::overlap_for_certain(squares);
      growing.grow(store_kept(some, certain, lanes, growing.end()));
      const auto undecided = without(SphereLanes::may_overlap(squares), certain);
      if (HWY_LIKELY(undecided.none())) return;
      Pair left[at_once + width];
      open.insert(open.end(), left, left + store_kept(some, undecided, lanes, left));
    });
  }
  for (const Pair& p : open)
    if (Robust::overlap(spheres[p.i], spheres[p.j])) found.push_back(p);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(all_within_here);
HWY_EXPORT(all_near_here);
HWY_EXPORT(part_pairs_here);
HWY_EXPORT(find_colliding_here);

bool all_within(std::span<const Sphere> now, std::span<const Sphere> thick) {
  return HWY_DYNAMIC_DISPATCH(all_within_here)(now, thick);
}
bool all_near(std::span<const Sphere> now, std::span<const Sphere> before, float skin) {
  return HWY_DYNAMIC_DISPATCH(all_near_here)(now, before, skin);
}
void part_pairs(std::span<const Sphere> spheres, std::span<const Pair> pairs, float skin,
                std::vector<Pair>& collide, std::vector<Pair>& open) {
  HWY_DYNAMIC_DISPATCH(part_pairs_here)(spheres, pairs, skin, collide, open);
}
void find_colliding(std::span<const Sphere> spheres, std::span<const Pair> pairs, std::size_t keep,
                    std::vector<Pair>& found) {
  HWY_DYNAMIC_DISPATCH(find_colliding_here)(spheres, pairs, keep, found);
}

}  // namespace catena
#endif
