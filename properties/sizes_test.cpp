#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "catena/core/error.h"
#include "catena/core/hierarchy/sphere_bounds_visitor.h"
#include "catena/properties/declared_limit.h"
#include "catena/properties/property.h"
#include "catena/reference/enclosure.h"

namespace catena::properties {
namespace {

/// A tangled walk: steps of one radius in random directions, so that many spheres collide.
std::vector<Sphere> tangle(std::uint32_t n, std::uint32_t seed, float scale = 1, float offset = 0) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<float>(random() % 20001) / 10000 - 1; };
  std::vector<Sphere> spheres;
  float x = 0, y = 0, z = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back(
        {x * scale + offset, y * scale - offset, z * scale + offset, scale * (0.5f + unit() / 4)});
    x += unit(), y += unit(), z += unit();
  }
  return spheres;
}

/// Of chains beyond this the all-pairs variants would take too long, and the rounded ones are code that the
/// exact ones have shown, in another arithmetic.
constexpr std::uint32_t long_chain = 600;

/// Every property on every available variant; one with a declared limit may refuse past it.
void expect_all_hold(const Case& test, const std::string& what) {
  static const auto subjects = Subject::available();
  static const auto properties = PropertyRegistry::instance().make_all();
  ASSERT_FALSE(subjects.empty());
  ASSERT_FALSE(properties.empty());
  for (const Subject& subject : subjects) {
    if ((subject.info.all_pairs || !subject.exact()) && test.chain.size() > long_chain) continue;
    const auto limit = declared_limit(subject);
    for (const auto& property : properties) {
      if (!property->applies_to(subject)) continue;
      try {
        const auto variant = subject.make();
        const auto failure = property->check(subject, *variant, test);
        EXPECT_FALSE(failure) << what << ", " << subject.info.name << ", " << property->name() << ": "
                              << *failure;
      } catch (const CapacityError& error) {
        EXPECT_TRUE(may_refuse(limit, test.chain.size()))
            << what << ", " << subject.info.name << ", " << property->name() << ": " << error.what();
      }
    }
  }
}

/// A refusal is no finding where, and only where, twice as many spheres are too many.
TEST(Sizes, AreAllowedToBeRefusedFromHalfOfTheLimitOn) {
  for (const char* name : {"bGPU2@host(block=4)+CPU2", "bGPU2@host(block=24)+CPU2", "aCPU2+CPU2"}) {
    const Subject subject = Subject::named(name);
    const auto limit = declared_limit(subject);
    for (std::uint32_t n = 0; n < 60; ++n) {
      bool refused = false;
      try {
        subject.make()->build(Chain(tangle(2 * n, n)));
      } catch (const CapacityError&) {
        refused = true;
      }
      EXPECT_EQ(may_refuse(limit, n), refused) << name << ", " << n;
    }
  }
}

TEST(Sizes, PowersOfTwoAndTheirNeighbours) {
  std::uint64_t pairs = 0;
  for (std::uint32_t n : {0u, 1u, 2u, 3u})
    expect_all_hold(Case::of(Chain(tangle(n, n))), "n = " + std::to_string(n));
  for (std::uint32_t power = 4; power <= 4096; power *= power < 1024 ? 2 : 4)
    for (std::uint32_t n : {power - 1, power, power + 1}) {
      const Case test = Case::of(Chain(tangle(n, n)));
      pairs += test.exact.pair_count;
      expect_all_hold(test, "n = " + std::to_string(n));
    }
  EXPECT_GT(pairs, 1000u) << "the reference sets must not be empty";
}

TEST(Sizes, SubtreesAndBlocksOfThePaper) {
  for (std::uint32_t n : {383u, 384u, 385u, 767u, 768u, 769u, 1535u, 1536u, 1537u, 2304u})
    expect_all_hold(Case::of(Chain(tangle(n, n))), "n = " + std::to_string(n));
}

TEST(Extremes, CoincidentAndZeroRadius) {
  for (float radius : {0.0f, 1e-45f, 1e-20f, 1.0f, 3e38f})
    for (std::uint32_t n : {2u, 3u, 7u, 33u, 130u})
      expect_all_hold(Case::of(Chain(std::vector<Sphere>(n, Sphere{1, -2, 3, radius}))),
                      "coincident, radius " + std::to_string(radius));
}

TEST(Extremes, EveryScaleOfBinary32) {
  constexpr int least = -149, greatest = 119, step = 6;
  for (int exponent = least; exponent < greatest + step; exponent += step) {
    const int scale = std::min(exponent, greatest);
    expect_all_hold(Case::of(Chain(tangle(100, 7, std::ldexp(1.0f, scale)))),
                    "scale 2^" + std::to_string(scale));
  }
}

TEST(Extremes, FarFromTheOrigin) {
  for (float offset : {1e3f, 1e5f, 1e6f, 1e7f, 1e9f, 1e20f, 1e30f, 3e38f})
    expect_all_hold(Case::of(Chain(tangle(100, 8, 1, offset))), "offset " + std::to_string(offset));
}

TEST(Extremes, ScalesMixedWithinOneChain) {
  std::mt19937 random(5);
  for (int round = 0; round < 30; ++round) {
    std::vector<Sphere> spheres;
    const auto number = [&](bool positive) {
      const float value =
          std::ldexp(static_cast<float>(random() % 1000) / 1000, static_cast<int>(random() % 270) - 148);
      return positive || random() % 2 ? value : -value;
    };
    for (int i = 0; i < 60; ++i)
      spheres.push_back({number(false), number(false), number(false), number(true)});
    expect_all_hold(Case::of(Chain(spheres)), "mixed scales, round " + std::to_string(round));
  }
}

TEST(Extremes, ExactlyTouchingLattice) {
  // A serpentine through the integer lattice: unit steps, radius 1/2: every lattice neighbour touches
  // exactly.
  std::vector<Sphere> spheres;
  for (int z = 0; z < 5; ++z)
    for (int k = 0; k < 25; ++k) {
      const int y = z % 2 ? 4 - k / 5 : k / 5, row = k / 5 + z * 5, x = row % 2 ? 4 - k % 5 : k % 5;
      spheres.push_back({float(x), float(y), float(z), 0.5f});
    }
  const Case test = Case::of(Chain(spheres));
  EXPECT_EQ(test.exact.pair_count, 300u - 124u) << "300 lattice edges, 124 of them along the chain";
  expect_all_hold(test, "lattice");
}

/// Depth and size of the paper's trees, for every construction.
class Depth final : public SphereBoundsVisitor {
 public:
  explicit Depth(std::uint32_t n) : builder(n) {}
  void sphere(std::uint32_t parent, const Sphere64&, std::uint32_t child, const Sphere64&) override {
    builder.add(parent, child);
  }
  void tree(const TreeFacts& facts) override { counted = facts.levels; }
  std::uint32_t counted = 0;
  reference::TreeShapeBuilder builder;
};

TEST(TreeShape, TwiceTheLeavesLessOneAndThePapersDepth) {
  for (const char* name : {"aCPU2+CPU2", "bGPU2@host+CPU2", "aGPU2@host+CPU2",
                           "aGPU2@host(subtree=6,block=2)+CPU2", "aGPU2@host(subtree=2,block=1)+CPU2"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    for (std::uint32_t n : {2u, 3u, 4u, 5u, 7u, 8u, 9u, 63u, 64u, 65u, 384u, 385u, 1000u, 1536u}) {
      variant->build(Chain(tangle(n, n)));
      Depth depth(n);
      variant->visit_bounds(depth);
      const auto shape = depth.builder.shape();
      EXPECT_TRUE(shape.is_tree()) << name << ' ' << n;
      EXPECT_EQ(shape.nodes, 2 * n - 1) << name << ' ' << n;
      EXPECT_EQ(shape.leaves, n) << name << ' ' << n;
      EXPECT_EQ(depth.counted, shape.depth) << name << ' ' << n;
      if (std::string(name) == "aCPU2+CPU2") {
        EXPECT_EQ(shape.depth, std::bit_width(n - 1) + 1) << "ceil(log2 n) + 1, n = " << n;
      }
    }
  }
}

TEST(TreeShape, OfMoreThanOneBlockTakesIsRefusedWithTheLimit) {
  const auto variant = StrategyRegistry::instance().make("bGPU2@host+CPU2");
  try {
    variant->build(Chain(tangle(1537, 1)));
    FAIL();
  } catch (const CapacityError& error) {
    EXPECT_STREQ(
        error.what(),
        "bGPU2@host takes at most 1536 spheres by one block of 768 threads, got 1537; use aGPU2@host");
  }
}

// A block takes twice as many roots as it has threads: 16 roots are one top, 17 another stage.
TEST(TreeShape, RootsOfAGPU2AreToppedByOneBlockWhileTheyFit) {
  const auto variant = StrategyRegistry::instance().make("aGPU2@host(subtree=6,block=8)+CPU2");
  for (const auto& [n, levels] : {std::pair{96u, 1u + 3 + 4}, {97u, 1u + 3 + 3 + 2}}) {
    variant->build(Chain(tangle(n, n)));
    Depth depth(n);
    variant->visit_bounds(depth);
    EXPECT_EQ(depth.builder.shape().depth, levels) << n;
  }
}

TEST(Flood, IsAClearErrorWithTheTrueNumberAndCountsStayRight) {
  const std::uint32_t n = 8'000;
  const Chain chain(std::vector<Sphere>(n, Sphere{0, 0, 0, 1}));
  const std::uint64_t expected = std::uint64_t{n} * (n - 1) / 2 - (n - 1);
  const auto variant = StrategyRegistry::instance().make("aCPU2+CPU2");
  variant->build(chain);
  Collisions found;
  try {
    variant->find(chain, {Request::Want::pairs, 1'000'000}, found);
    FAIL() << "a flood was accepted";
  } catch (const PairLimitExceeded& error) {
    EXPECT_EQ(error.found(), expected);
    EXPECT_EQ(found.pairs.capacity(), 0u);
  }
  variant->find(chain, {Request::Want::counts}, found);
  EXPECT_EQ(found.pair_count, expected);
  EXPECT_EQ(found.count[0], n - 2);
  EXPECT_EQ(found.count[n / 2], n - 3);
}

/// Half a minute for each traversal, as every pair is counted.
TEST(SizesLong, MoreThan2To32PairsAreCounted) {
  const std::uint32_t n = 93'000;
  const Chain chain(std::vector<Sphere>(n, Sphere{0, 0, 0, 1}));
  const std::uint64_t expected = std::uint64_t{n} * (n - 1) / 2 - (n - 1);
  ASSERT_GT(expected, std::uint64_t{1} << 32);
  for (const Subject& subject : Subject::available()) {
    const auto& stages = subject.info.parts.stages;
    const bool asked = stages.size() == 2 && stages[0].strategy == "aCPU2" && subject.exact();
    if (!asked || subject.info.on_device()) continue;
    const auto variant = subject.make();
    Collisions found;
    variant->build(chain);
    variant->find(chain, {Request::Want::counts}, found);
    EXPECT_EQ(found.pair_count, expected) << subject.info.name;
    EXPECT_EQ(found.count[n / 2], n - 3) << subject.info.name;
    try {
      variant->find(chain, {Request::Want::pairs, 1000}, found);
      ADD_FAILURE() << subject.info.name << " takes a flood";
    } catch (const PairLimitExceeded& error) {
      EXPECT_EQ(error.found(), expected) << subject.info.name;
    }
  }
}

}  // namespace
}  // namespace catena::properties
