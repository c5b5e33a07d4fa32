#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <filesystem>

#include "catena/core/arithmetic/exact_sign.h"
#include "catena/core/arithmetic/robust.h"
#include "catena/core/readers/chain_format.h"
#include "catena/properties/fuzz/failure_store.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/shapes.h"
#include "catena/properties/testing/ulp_ladder.h"
#include "catena/reference/exact_gap.h"

/// A decision that no one here wrote: rational numbers of Boost.Multiprecision, which take a float as the
/// fraction that it is. It judges the expansions of core/ and the integers of reference/, and they judge it.
namespace catena::properties {
namespace {

using Rational = boost::multiprecision::cpp_rational;

int sign_by_rationals(const Sphere& a, const Sphere& b) {
  const auto square = [](const Rational& v) -> Rational { return v * v; };
  const Rational reach = Rational(a.radius) + Rational(b.radius);
  const Rational gap = square(Rational(b.x) - Rational(a.x)) + square(Rational(b.y) - Rational(a.y)) +
                       square(Rational(b.z) - Rational(a.z)) - square(reach);
  return gap.sign();
}

/// All of catena's exact decisions about a pair against the rationals; where they differ the run fails, with
/// the pair.
class Judges {
 public:
  void judge(const Sphere& a, const Sphere& b) {
    const int right = sign_by_rationals(a, b);
    ++seen_[static_cast<std::size_t>(right + 1)];
    const bool agree = reference::gap_sign(a, b) == right && reference::gap_sign_by_integers(a, b) == right &&
                       ExactSign::of_gap(a, b) == right && Robust::overlap(a, b) == (right <= 0);
    if (agree || ++disagreements_ > 5) return;
    ADD_FAILURE() << fmt::format("({:a}, {:a}, {:a}, {:a}) and ({:a}, {:a}, {:a}, {:a}): rationals say {}",
                                 a.x, a.y, a.z, a.radius, b.x, b.y, b.z, b.radius, right);
  }
  std::uint64_t apart() const { return seen_[2]; }
  std::uint64_t touching() const { return seen_[1]; }
  std::uint64_t overlapping() const { return seen_[0]; }
  std::uint64_t all() const { return apart() + touching() + overlapping(); }

 private:
  std::array<std::uint64_t, 3> seen_{};
  std::uint64_t disagreements_ = 0;
};

/// Two spheres that nearly touch: b is put where it touches a in real numbers, then rounded, then moved by
/// some ulps.
std::array<Sphere, 2> near_tie(Dice& dice) {
  const auto wide = [&](int least, int greatest) {
    return std::ldexp(1 + dice.unit(), dice.between(least, greatest)) * dice.pick({1.0f, -1.0f});
  };
  const int size = dice.between(-130, 110);
  const Sphere a{wide(size - 3, size + 6), wide(size - 3, size + 6), wide(size - 3, size + 6),
                 std::fabs(wide(size - 20, size + 2))};
  const float radius = std::fabs(wide(size - 20, size + 2));
  const double x = dice.symmetric(), y = dice.symmetric(), z = dice.symmetric() + 1e-3;
  const double part = (double{a.radius} + radius) / std::sqrt(x * x + y * y + z * z);
  Sphere b{static_cast<float>(a.x + part * x), static_cast<float>(a.y + part * y),
           static_cast<float>(a.z + part * z), radius};
  for (float* number : {&b.x, &b.y, &b.z, &b.radius})
    if (dice.one_in(4)) *number = moved_by_ulps(*number, dice.between(-2, 2));
  b.radius = std::fabs(b.radius);
  return {a, b};
}

void judge_near_ties(std::uint32_t pairs, std::uint64_t seed) {
  Dice dice(seed);
  Judges judges;
  for (std::uint32_t k = 0; k < pairs; ++k) {
    const auto [a, b] = near_tie(dice);
    judges.judge(a, b);
  }
  EXPECT_EQ(judges.all(), pairs);
  EXPECT_GT(judges.apart(), pairs / 5);
  EXPECT_GT(judges.overlapping(), pairs / 5);
}

TEST(SecondArithmetic, AgreesOnTheUlpLadder) {
  Judges judges;
  climb_ulps([&](int, bool, const Sphere& a, const Sphere& b) { judges.judge(a, b); });
  EXPECT_GT(judges.touching(), 5000u);
  EXPECT_GT(judges.apart(), 5000u);
  EXPECT_GT(judges.overlapping(), 5000u);
}

TEST(SecondArithmetic, AgreesOnEveryPairOfTheCorpusAndTheCounterexamples) {
  Judges judges;
  for (const char* folder : {"properties/corpus", "properties/counterexamples"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(CATENA_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".chain") continue;
      const Chain chain = load_chain(entry.path());
      for (std::uint32_t i = 0; i < chain.size(); ++i)
        for (std::uint32_t j = i + 1; j < chain.size(); ++j) judges.judge(chain[i], chain[j]);
    }
  EXPECT_GT(judges.all(), 20u);
}

TEST(SecondArithmetic, AgreesOnRandomNearTies) { judge_near_ties(100'000, 1); }

TEST(SecondArithmeticLong, AgreesOnAMillionRandomNearTies) { judge_near_ties(1'000'000, 2); }

TEST(SecondArithmetic, KnowsTouchingFromAlmostTouching) {
  const Sphere a{0, 0, 0, 1}, b{3, 4, 12, 12};
  EXPECT_EQ(sign_by_rationals(a, b), 0);
  EXPECT_EQ(sign_by_rationals(a, {3, 4, 12, std::nextafter(12.0f, 13.0f)}), -1);
  EXPECT_EQ(sign_by_rationals({0x1p-149f, 0, 0, 0}, {0, 0, 0, 0}), 1);
}

}  // namespace
}  // namespace catena::properties
