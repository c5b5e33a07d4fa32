#pragma once
#include <cstdint>
#include <random>

namespace catena::reference {

/// Tells whether many products of sets cover all pairs exactly once, without storing any of them.
///
/// Every sphere i is given two random numbers r_i, c_i below the prime p = 2^61 - 1; a set A of spheres has
/// the weight (R_A, C_A), the sums over its members. The sum of R_A * C_B over all products A x B is a
/// polynomial in the r_i, c_j whose coefficient at r_i * c_j is the number of times that the ordered pair (i,
/// j) is covered. So if every pair is covered once and none (i, i), it equals sum over i != j of r_i * c_j,
/// always; if not, the two differ as polynomials of degree 2 and agree for at most 2 in p draws (Schwartz
/// 1980, Zippel 1979): once in 10^18 checks. Unordered pairs: R_A * C_B + R_B * C_A. Fewer than p coverings
/// of a pair are assumed.
class Fingerprint {
 public:
  static constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1;
  struct Weight {
    std::uint64_t row = 0, column = 0;  ///< below the prime
    friend bool operator==(const Weight&, const Weight&) = default;
  };
  enum class Pairs { ordered, unordered };

  explicit Fingerprint(Pairs pairs) : unordered_(pairs == Pairs::unordered) {}

  /// Covers A x B. One search covers many sets with one A, so products are left until A changes.
  void add(const Weight& a, const Weight& b) {
    if (!(a == a_)) flush(), a_ = a;
    columns_ += b.column;
    rows_ += b.row;
  }
  std::uint64_t value() const {
    Fingerprint all = *this;
    all.flush();
    return all.value_;
  }

  static Weight random(std::mt19937_64& source) { return {source() % prime, source() % prime}; }
  static std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return reduced(Wide{a} + b); }
  static std::uint64_t difference(std::uint64_t a, std::uint64_t b) { return reduced(Wide{a} + prime - b); }
  static std::uint64_t product(std::uint64_t a, std::uint64_t b) { return reduced(Wide{a} * b); }

 private:
  using Wide = unsigned __int128;  // 2^67 numbers below 2^61 fit
  /// value mod p, by 2^61 = 1 (mod p): the first fold leaves less than 2^68, the second at most p + 128.
  static std::uint64_t reduced(Wide value) {
    value = (value & prime) + (value >> 61);
    value = (value & prime) + (value >> 61);
    return static_cast<std::uint64_t>(value < prime ? value : value - prime);
  }
  void flush() {
    value_ = sum(value_, product(a_.row, reduced(columns_)));
    if (unordered_) value_ = sum(value_, product(a_.column, reduced(rows_)));
    columns_ = rows_ = 0;
  }

  bool unordered_;
  Weight a_;
  Wide columns_ = 0, rows_ = 0;
  std::uint64_t value_ = 0;
};

}  // namespace catena::reference
