// Chains of which one part has more than 2^60 times the radius of another: a tree in the chain's order alone
// has one scale for all of it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/reference.h"
#include "catena/reference/verify.h"

namespace catena::properties {
namespace {

/// Radii from 10^-d/2 to 10^d/2, every other one a speck; straight where `turn` is 0, along no axis, and else
/// a spiral that narrows.
std::vector<Sphere> horn(std::uint32_t n, double decades, double jump, double turn) {
  std::vector<Sphere> spheres;
  double x = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double size = std::pow(10.0, decades * ((i + 0.5) / n - 0.5));
    const double wide = turn == 0 ? 0 : 2 * size, at = turn * i;
    const double y = 0.6 * x + wide * std::sin(at), z = -0.3 * x + wide * std::cos(at);
    spheres.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
                       static_cast<float>(i % 2 == 0 ? size : size / jump)});
    x += size / 2;
  }
  return spheres;
}

std::uint64_t left_open(const Chain& chain) {
  const auto variant = StrategyRegistry::instance().make("ChainTree");
  Collisions found;
  variant->build(chain);
  variant->find(chain, {}, found);
  return variant->work().back().times;
}

TEST(ManyDecades, AreCertifiedAndCostTheChainsOrderNoMoreThanFew) {
  for (const double decades : {0., 14., 24., 32., 40., 60.})
    for (const double jump : {1., 1e6})
      for (const double turn : {0., 0.1}) {
        const Chain chain(horn(2000, decades, jump, turn));
        const std::string what = "decades=" + std::to_string(decades) + " jump=" + std::to_string(jump) +
                                 " turn=" + std::to_string(turn);
        for (const char* name : {"ChainTree", "Hybrid"}) {
          const auto variant = StrategyRegistry::instance().make(name);
          std::uint64_t proved = 0;
          const auto v = reference::verify_by_certificate(*variant, chain, 1u << 24, proved);
          EXPECT_EQ(v.verdict, reference::Verdict::exact) << name << ' ' << what << ": " << v.reason;
          EXPECT_GT(proved, chain.size() / 4) << what;
          ASSERT_TRUE(v.certificate) << what;
          if (decades <= 40) {
            EXPECT_LT(v.certificate->tested, 40 * chain.size()) << name << ' ' << what << ": of 1,000 each";
          }
        }
        if (decades <= 40) {
          EXPECT_LT(left_open(chain), chain.size() / 4) << what << ": of 20 each";
        }
      }
}

/// What is small may lie where what is large does, and far from anything: in units of its own, coordinates
/// must not overflow.
TEST(ManyDecades, AreComparedInUnitsThatNoCoordinateOverflows) {
  Dice dice(36);
  const auto tree = StrategyRegistry::instance().make("ChainTree");
  std::uint64_t pairs = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Sphere> spheres;
    const int far = static_cast<int>(dice.below(240)) - 120;
    while (spheres.size() < 200) {
      const int size = static_cast<int>(dice.below(200)) - 140;
      const auto at = [&](int exponent) { return std::ldexp(dice.symmetric(), exponent); };
      const bool near = dice.one_in(2);
      const float x = near ? 0.0f : at(far), y = near ? 0.0f : at(far), z = near ? 0.0f : at(far);
      for (std::uint32_t k = 0; k < 12; ++k)  // where it is far, these are one point
        spheres.push_back({x + at(size), y + at(size), z + at(size), std::ldexp(dice.unit(), size)});
    }
    const Chain chain(std::move(spheres));
    const auto right = reference::find(chain);
    pairs += right.pair_count;
    Collisions found;
    tree->build(chain);
    tree->find(chain, {}, found);
    sort(found.pairs);
    ASSERT_EQ(found.pairs, right.pairs) << "round " << round;
    ASSERT_EQ(found.count, right.count) << "round " << round;
  }
  EXPECT_GT(pairs, 50000u);
}

}  // namespace
}  // namespace catena::properties
