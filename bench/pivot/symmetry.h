#pragma once
#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>

namespace catena::bench {

/// A point of the cubic lattice, or a step between two.
struct LatticePoint {
  std::int32_t x = 0, y = 0, z = 0;

  friend LatticePoint operator+(const LatticePoint& a, const LatticePoint& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend LatticePoint operator-(const LatticePoint& a, const LatticePoint& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

/// One of the 48 rotations and reflections that map the cubic lattice and its origin onto themselves.
class LatticeSymmetry {
 public:
  static constexpr int count = 48;

  LatticeSymmetry() = default;  ///< the identity
  /// 0 to 47; 0 is the identity.
  static LatticeSymmetry number(int k) {
    LatticeSymmetry symmetry;
    symmetry.number_ = static_cast<std::uint8_t>(k);
    return symmetry;
  }
  /// This one after that one.
  LatticeSymmetry after(LatticeSymmetry first) const { return number(products_[number_][first.number_]); }
  LatticeSymmetry inverse() const { return number(inverses_[number_]); }
  int number() const { return number_; }
  /// Where the image takes its lanes from, of a vector x, y, z, any, -x, -y, -z, any: then no sign is needed.
  const std::int32_t* lanes() const { return lanes_[number_].data(); }

  LatticePoint operator()(const LatticePoint& p) const {
    const Signed& s = all_[number_];
    const std::array<std::int32_t, 3> old{p.x, p.y, p.z};
    return {s.sign[0] * old[s.from[0]], s.sign[1] * old[s.from[1]], s.sign[2] * old[s.from[2]]};
  }
  friend bool operator==(LatticeSymmetry, LatticeSymmetry) = default;

 private:
  /// Coordinate k of the image: sign[k] times coordinate from[k].
  struct Signed {
    std::array<std::int8_t, 3> sign;
    std::array<std::uint8_t, 3> from;
    friend bool operator==(const Signed&, const Signed&) = default;
  };
  using Table = std::array<Signed, count>;
  using Products = std::array<std::array<std::uint8_t, count>, count>;
  using Inverses = std::array<std::uint8_t, count>;
  struct alignas(32) EightLanes : std::array<std::int32_t, 8> {};
  using Lanes = std::array<EightLanes, count>;
  static constexpr Table make_table();
  static Products make_products();
  static Inverses make_inverses();
  static Lanes make_lanes();
  static const Table all_;
  static const Products products_;
  static const Inverses inverses_;
  static const Lanes lanes_;

  std::uint8_t number_ = 0;
};

/// A symmetry, then a move by whole steps.
struct LatticeMove {
  LatticeSymmetry turn;
  LatticePoint shift;

  LatticePoint operator()(const LatticePoint& p) const { return turn(p) + shift; }
  LatticeMove after(const LatticeMove& first) const { return {turn.after(first.turn), (*this)(first.shift)}; }
};

}  // namespace catena::bench
