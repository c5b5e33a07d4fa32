// Sixteen binary32 numbers side by side, in as many vectors as the target needs. Compiled once a target: no
// include guard but Highway's.
#if defined(CATENA_CORE_BLOCKS_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_LANES_INL_H
#undef CATENA_CORE_BLOCKS_LANES_INL_H
#else
#define CATENA_CORE_BLOCKS_LANES_INL_H
#endif

#include <bit>
#include <cstdint>
#include <cstring>

#include "catena/core/blocks/simd_targets.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Lanes or flags of which vector k is make(k).
template <class Of, class Make>
HWY_INLINE Of by_parts(const Make& make) {
  if constexpr (Of::parts == 1) return {{make(0)}};
  if constexpr (Of::parts == 2) return {{make(0), make(1)}};
  if constexpr (Of::parts == 4) return {{make(0), make(1), make(2), make(3)}};
  Of result;
#if HWY_TARGET == HWY_SCALAR
#pragma GCC unroll 1  // sixteen parts, which would take minutes to compile in a row
#endif
  for (std::size_t k = 0; k < Of::parts; ++k) result.part[k] = make(k);
  return result;
}

/// `count` lanes of float, 16 or 8, each operation done on all of them. What is made of these is const
/// nowhere within a function: GCC 12 leaves a const aggregate in memory ("store to a read-only decl" in its
/// -fdump-tree-sra), and copies one of several vectors by pieces of other sizes, which waits for the stores
/// before.
template <std::size_t count>
struct Lanes {
  using Tag = hn::CappedTag<float, count>;
  static constexpr std::size_t width = hn::MaxLanes(Tag()), parts = count / width;
  hn::Vec<Tag> part[parts];

  template <class Make>
  static HWY_INLINE Lanes from(const Make& make) {
    return by_parts<Lanes>(make);
  }
  static HWY_INLINE Lanes all(float value) {
    return from([&](std::size_t) { return hn::Set(Tag(), value); });
  }
  static HWY_INLINE Lanes load(const float* from_memory) {
    return from([&](std::size_t k) { return hn::LoadU(Tag(), from_memory + k * width); });
  }
  HWY_INLINE void store(float* to) const {
    for (std::size_t k = 0; k < parts; ++k) hn::StoreU(part[k], Tag(), to + k * width);
  }
  friend HWY_INLINE Lanes operator+(const Lanes& a, const Lanes& b) {
    return from([&](std::size_t k) { return hn::Add(a.part[k], b.part[k]); });
  }
  friend HWY_INLINE Lanes operator-(const Lanes& a, const Lanes& b) {
    return from([&](std::size_t k) { return hn::Sub(a.part[k], b.part[k]); });
  }
  friend HWY_INLINE Lanes operator*(const Lanes& a, const Lanes& b) {
    return from([&](std::size_t k) { return hn::Mul(a.part[k], b.part[k]); });
  }
  friend HWY_INLINE Lanes operator/(const Lanes& a, const Lanes& b) {
    return from([&](std::size_t k) { return hn::Div(a.part[k], b.part[k]); });
  }
};

/// A flag a lane, as the target keeps it.
template <std::size_t count>
struct Flags {
  using Tag = typename Lanes<count>::Tag;
  static constexpr std::size_t width = Lanes<count>::width, parts = Lanes<count>::parts;
  hn::Mask<Tag> part[parts];

  template <class Make>
  static HWY_INLINE Flags from(const Make& make) {
    return by_parts<Flags>(make);
  }
  /// Bit k is the flag of lane k.
  HWY_INLINE std::uint32_t bits() const {
    std::uint32_t result = 0;
    for (std::size_t k = 0; k < parts; ++k) {
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(Tag(), part[k], bytes);
      std::uint32_t some;
      std::memcpy(&some, bytes, sizeof some);
      result |= some << (k * width);
    }
    return result;
  }
  HWY_INLINE bool none() const {
    auto folded = part[0];
    for (std::size_t k = 1; k < parts; ++k) folded = hn::Or(folded, part[k]);
    return hn::AllFalse(Tag(), folded);
  }
  friend HWY_INLINE Flags operator|(const Flags& a, const Flags& b) {
    return from([&](std::size_t k) { return hn::Or(a.part[k], b.part[k]); });
  }
  friend HWY_INLINE Flags operator&(const Flags& a, const Flags& b) {
    return from([&](std::size_t k) { return hn::And(a.part[k], b.part[k]); });
  }
};

template <std::size_t n>
HWY_INLINE Lanes<n> min(const Lanes<n>& a, const Lanes<n>& b) {
  return Lanes<n>::from([&](std::size_t k) { return hn::Min(a.part[k], b.part[k]); });
}
template <std::size_t n>
HWY_INLINE Lanes<n> max(const Lanes<n>& a, const Lanes<n>& b) {
  return Lanes<n>::from([&](std::size_t k) { return hn::Max(a.part[k], b.part[k]); });
}
template <std::size_t n>
HWY_INLINE Lanes<n> abs(const Lanes<n>& a) {
  return Lanes<n>::from([&](std::size_t k) { return hn::Abs(a.part[k]); });
}
template <std::size_t n>
HWY_INLINE Lanes<n> sqrt(const Lanes<n>& a) {
  return Lanes<n>::from([&](std::size_t k) { return hn::Sqrt(a.part[k]); });
}
/// About 1 / a, of the target's own accuracy: for guesses, never for what must be the same everywhere.
template <std::size_t n>
HWY_INLINE Lanes<n> guess_reciprocal(const Lanes<n>& a) {
  return Lanes<n>::from([&](std::size_t k) { return hn::ApproximateReciprocal(a.part[k]); });
}
/// a * b + c, rounded once or twice.
template <std::size_t n>
HWY_INLINE Lanes<n> mul_add(const Lanes<n>& a, const Lanes<n>& b, const Lanes<n>& c) {
  return Lanes<n>::from([&](std::size_t k) { return hn::MulAdd(a.part[k], b.part[k], c.part[k]); });
}
/// c - a * b, rounded once or twice.
template <std::size_t n>
HWY_INLINE Lanes<n> neg_mul_add(const Lanes<n>& a, const Lanes<n>& b, const Lanes<n>& c) {
  return Lanes<n>::from([&](std::size_t k) { return hn::NegMulAdd(a.part[k], b.part[k], c.part[k]); });
}
template <std::size_t n>
HWY_INLINE Flags<n> operator<(const Lanes<n>& a, const Lanes<n>& b) {
  return Flags<n>::from([&](std::size_t k) { return hn::Lt(a.part[k], b.part[k]); });
}
/// True for a NaN.
template <std::size_t n>
HWY_INLINE Flags<n> not_less(const Lanes<n>& a, const Lanes<n>& b) {
  return Flags<n>::from([&](std::size_t k) { return hn::Not(hn::Lt(a.part[k], b.part[k])); });
}
template <std::size_t n>
HWY_INLINE Flags<n> operator<=(const Lanes<n>& a, const Lanes<n>& b) {
  return Flags<n>::from([&](std::size_t k) { return hn::Le(a.part[k], b.part[k]); });
}
template <std::size_t n>
HWY_INLINE Lanes<n> select(const Flags<n>& flags, const Lanes<n>& yes, const Lanes<n>& no) {
  return Lanes<n>::from(
      [&](std::size_t k) { return hn::IfThenElse(flags.part[k], yes.part[k], no.part[k]); });
}

/// The bits of the first `count` of sixteen lanes.
HWY_INLINE std::uint32_t lane_bits(std::uint32_t count) { return count >= 16 ? 0xFFFFu : (1u << count) - 1; }
/// The lanes whose bits are set, in turn.
template <class Body>
HWY_INLINE void for_each_lane(std::uint32_t bits, const Body& body) {
  for (; bits != 0; bits &= bits - 1) body(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

using Lanes16 = Lanes<16>;
using Lanes8 = Lanes<8>;

/// A vector of space a lane.
template <std::size_t n>
struct VectorsOf {
  Lanes<n> x, y, z;

  static HWY_INLINE VectorsOf load(const float* fields) {
    return {Lanes<n>::load(fields), Lanes<n>::load(fields + n), Lanes<n>::load(fields + 2 * n)};
  }
  /// Lane `lane` of fields laid out for load(), in all lanes.
  static HWY_INLINE VectorsOf all(const float* fields, std::uint32_t lane) {
    return {Lanes<n>::all(fields[lane]), Lanes<n>::all(fields[n + lane]),
            Lanes<n>::all(fields[2 * n + lane])};
  }
  HWY_INLINE void store(float* fields) const {
    x.store(fields), y.store(fields + n), z.store(fields + 2 * n);
  }
  friend HWY_INLINE VectorsOf operator+(const VectorsOf& a, const VectorsOf& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE VectorsOf operator-(const VectorsOf& a, const VectorsOf& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};
using Vectors = VectorsOf<16>;

template <std::size_t n>
HWY_INLINE Lanes<n> dot(const VectorsOf<n>& a, const VectorsOf<n>& b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z));
}
/// What products have on top of which but differences are looked at: by some 2^-133 these are wrong for it,
/// less than BlockTree::tiny.
constexpr float least_product = 0x1p-110f;

/// With `least` on top: then no product underflows, which would cost digits, and a hundred times the time.
template <std::size_t n>
HWY_INLINE Lanes<n> dot(const VectorsOf<n>& a, const VectorsOf<n>& b, const Lanes<n>& least) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, mul_add(a.z, b.z, least)));
}
/// a + t b and a - t b.
template <std::size_t n>
HWY_INLINE VectorsOf<n> plus(const VectorsOf<n>& a, const Lanes<n>& t, const VectorsOf<n>& b) {
  return {mul_add(t, b.x, a.x), mul_add(t, b.y, a.y), mul_add(t, b.z, a.z)};
}
template <std::size_t n>
HWY_INLINE VectorsOf<n> minus(const VectorsOf<n>& a, const Lanes<n>& t, const VectorsOf<n>& b) {
  return {neg_mul_add(t, b.x, a.x), neg_mul_add(t, b.y, a.y), neg_mul_add(t, b.z, a.z)};
}
/// |x| + |y| + |z|, at least the length.
template <std::size_t n>
HWY_INLINE Lanes<n> sum_of_sides(const VectorsOf<n>& a) {
  return abs(a.x) + abs(a.y) + abs(a.z);
}

HWY_INLINE Vectors select(const Flags<16>& flags, const Vectors& yes, const Vectors& no) {
  return {select(flags, yes.x, no.x), select(flags, yes.y, no.y), select(flags, yes.z, no.z)};
}

/// Twice as many lanes. Two chains of operations side by side wait for one another's results less than one
/// after the other: few of the second find room among what waits of the first.
template <std::size_t n>
HWY_INLINE Lanes<2 * n> side_by_side(const Lanes<n>& a, const Lanes<n>& b) {
  constexpr std::size_t parts = Lanes<n>::parts;
  return Lanes<2 * n>::from([&](std::size_t k) { return k < parts ? a.part[k] : b.part[k - parts]; });
}
template <std::size_t n>
HWY_INLINE VectorsOf<2 * n> side_by_side(const VectorsOf<n>& a, const VectorsOf<n>& b) {
  return {side_by_side(a.x, b.x), side_by_side(a.y, b.y), side_by_side(a.z, b.z)};
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
