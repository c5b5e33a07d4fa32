// Hilbert's curve, for numbers and for vectors of them.
#if defined(CATENA_CORE_SPACE_TREE_HILBERT_CURVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPACE_TREE_HILBERT_CURVE_INL_H
#undef CATENA_CORE_SPACE_TREE_HILBERT_CURVE_INL_H
#else
#define CATENA_CORE_SPACE_TREE_HILBERT_CURVE_INL_H
#endif

#include <cstdint>

#include "catena/core/blocks/simd_targets.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Hilbert's curve through the cubes of space: two that follow one another on it share a face, where Morton's
/// leaps, so that stretches of it are about half as wide in sum.
class HilbertCurve {
 public:
  /// The place on the curve, below 8^levels, of the cube at these coordinates, below 2^levels each; at most
  /// 10 levels deep. A bijection; half the bits of the coordinates, the upper ones, give the upper half of
  /// the place. Bits is std::uint32_t, or several of them side by side.
  template <class Bits>
  static HWY_INLINE Bits place(Bits x, Bits y, Bits z, int levels) {
    // Skilling 2004: down from the greatest cubes, what is below each is turned as the curve runs through it.
    const auto turn = [&x](Bits& v, int l) HWY_ATTR {
      const Bits below((1u << l) - 1), set = spread_bit(v, l), differ = x ^ v;
      x = x ^ (below & (set | differ));  // all of it where set, else what differs
      v = v ^ (below & differ & ~set);   // the two exchanged, then
    };
    for (int l = levels - 1; l > 0; --l) {
      x = x ^ (Bits((1u << l) - 1) & spread_bit(x, l));
      turn(y, l);
      turn(z, l);
    }
    // The three are Gray's code of the place, bit by bit.
    y = y ^ x;
    z = z ^ y;
    Bits odd = z ^ z >> 1;
    odd = odd ^ odd >> 2;
    odd = odd ^ odd >> 4;
    odd = odd ^ odd >> 8;
    odd = odd >> 1;
    return spread(x ^ odd) << 2 | spread(y ^ odd) << 1 | spread(z ^ odd);
  }

 private:
  /// All bits set where bit l is.
  static HWY_INLINE std::uint32_t spread_bit(std::uint32_t v, int l) { return 0 - (v >> l & 1); }
  template <class Bits>
  static HWY_INLINE Bits spread_bit(Bits v, int l) {
    return (v << (31 - l)).sign();
  }
  /// Two zeros after each bit of ten.
  template <class Bits>
  static HWY_INLINE Bits spread(Bits v) {
    v = (v | v << 16) & Bits(0x030000FFu);
    v = (v | v << 8) & Bits(0x0300F00Fu);
    v = (v | v << 4) & Bits(0x030C30C3u);
    return (v | v << 2) & Bits(0x09249249u);
  }
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
