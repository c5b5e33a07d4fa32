#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "catena/core/input/input.h"
#include "catena/core/plan/find.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

TEST(UnusualKind, IsToldByTheExtentAndItsVariantGivesTheAnswerOfAllPairs) {
  std::vector<std::string> taken;
  for (const char* input :
       {"yarn:n=1000", "path1:n=700", "mixed_radii:n=3000,decades=30", "mixed_radii:n=700,decades=60",
        "mixed_radii:n=300,jump=1e20", "subnormal:n=700", "hair:n=3000,radius=1e-41", "serpentine:n=1000",
        "cluster:n=700,shells=140", "yarn:n=6000", "tight_knot:n=1500", "hair:n=1000,strands=1000",
        "hair:n=2000,strands=20"}) {
    const Chain chain = open_input(input).animation->frame(0);
    const UnusualKind* const kind = UnusualKind::of(chain.size(), chain.view().extent, chain.spheres());
    ASSERT_NE(kind, nullptr) << input;
    taken.push_back(kind->variant);
    const auto all = StrategyRegistry::instance().make("CPU1");
    const auto variant = StrategyRegistry::instance().make(kind->variant);
    Collisions exact, found;
    for (const auto& [of, result] : {std::pair(all.get(), &exact), {variant.get(), &found}}) {
      of->build(chain);
      of->find(chain, {}, *result);
      std::ranges::sort(result->pairs);
    }
    EXPECT_EQ(found.pairs, exact.pairs) << input;
    EXPECT_EQ(find(chain).count, exact.count) << input;
    const auto planned = StrategyRegistry::instance().make("auto");
    planned->build(chain);
    EXPECT_EQ(planned->answered_by(), kind->variant) << input;
    const std::string reason = planned->plan().front().reason;
    EXPECT_NE(reason.find(kind->reason), std::string::npos) << reason;
  }
  EXPECT_EQ(taken[0], "Grid");
  EXPECT_EQ(taken[1], "ChainTree");
  EXPECT_EQ(taken[2], "aCPU2+Dual");
  EXPECT_EQ(taken[5], "Grid");
  EXPECT_EQ(taken[7], "SphereTree") << "crowded";
  EXPECT_EQ(taken[10], "ChainTree") << "a smooth tube";
  EXPECT_EQ(taken[9], "Grid") << "crowded, and its parts lie among one another";
  EXPECT_EQ(taken[8], "SphereTree") << "of unlike radii, whose parts do not lie apart";
  EXPECT_EQ(taken[11], "SphereTree") << "strands shorter than a block, anywhere";
  EXPECT_EQ(taken[12], "ChainTree") << "long strands";
  for (const char* usual :
       {"winding:n=30000", "lattice:n=3000", "tight_knot:n=30000", "mixed_radii:n=3000,decades=6",
        "points:n=3000,share=0.7", "lattice:n=3000,scale=1e-30", "cluster:n=30000",
        "far:n=3000,exponent=20,radius=1e24", "smallest:n=3000"}) {
    const Chain chain = open_input(usual).animation->frame(0);
    EXPECT_EQ(UnusualKind::of(chain.size(), chain.view().extent, chain.spheres()), nullptr) << usual;
  }
  // One speck among crowded spheres does not make the chain's order the better one.
  auto spheres = open_input("yarn:n=3000").animation->frame(0);
  std::vector<Sphere> specked(spheres.spheres().begin(), spheres.spheres().end());
  specked[1000].radius = 1e-25f;
  const Chain chain(specked);
  EXPECT_EQ(UnusualKind::of(chain.size(), chain.view().extent, chain.spheres()), nullptr);
  EXPECT_EQ(UnusualKind::of(100, Extent(), {}), nullptr) << "nothing is known";
}

/// By what the reasons say: how many spheres, how like their radii are, and how much of a cube as wide as the
/// chain cubes around them fill.
TEST(UnusualKind, OfAShortChainIsToldByWhatItsReasonSays) {
  std::mt19937 dice(4);
  const auto power = [&](double low, double high) {
    return std::pow(10, std::uniform_real_distribution<double>(low, high)(dice));
  };
  std::size_t of_each[3] = {};
  for (int k = 0; k < 2000; ++k) {
    const std::uint32_t n = k % 8 < 3 ? 2047 + k % 8 : static_cast<std::uint32_t>(power(0, 3.3));
    const auto radius = static_cast<float>(power(-3, 0));
    const float least = k % 3 == 0 ? radius / 2 : k % 3 == 1 ? radius : std::nextafter(radius / 2, 0.f);
    const double mean = radius * std::cbrt(n) * power(-2, 1.2);
    const Extent extent{least, radius, 3 * mean, static_cast<float>(mean)};
    const UnusualKind* const kind = UnusualKind::of(n, extent, {});
    if (n > 2048) {
      EXPECT_TRUE(kind == nullptr || kind->reason.find("at most 2,048") == std::string::npos) << n;
      continue;
    }
    ASSERT_NE(kind, nullptr) << n;
    const double filled = n * std::pow(2 * radius / (mean + 2 * radius), 3);
    const int which = filled <= 0.25 ? 0 : 2 * least < radius || filled > 6 ? 1 : 2;
    ++of_each[which];
    constexpr const char* variants[] = {"ChainTree", "SphereTree", "Grid"};
    EXPECT_EQ(kind->variant, variants[which]) << n << ' ' << filled;
  }
  for (const std::size_t times : of_each) EXPECT_GT(times, 100u);
}

/// Very few spheres are searched before it is seen how they lie.
TEST(UnusualKind, OfASmoothTubeIsSeenFrom513SpheresOn) {
  for (const std::uint32_t n : {500u, 512u, 513u, 2000u}) {
    std::vector<Sphere> tube;
    for (std::uint32_t i = 0; i < n; ++i) tube.push_back({static_cast<float>(i) * 0.01f, 0, 0, 1});
    const Chain chain(std::move(tube));
    EXPECT_EQ(UnusualKind::of(n, {1, 1, 3 * std::cbrt(n), 0}, chain.spheres())->variant,
              n > 512 ? "ChainTree" : "Grid")
        << n;
  }
}

/// A straight chain of so many, of whose rows of eight so many of sixteen lie across their box.
std::string kind_of_rows(std::uint32_t n, std::size_t across) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 0.25f});
  for (std::size_t k = 0; k < across; ++k) {
    const std::size_t i = k * (n - 8) / 15;
    spheres[i + 7].x = i < n / 2 ? static_cast<float>(n) : 0;
    spheres[i + 7].y = 0.5f;
  }
  const Chain chain(spheres);
  return UnusualKind::of(n, chain.view().extent, chain.spheres())->variant;
}

TEST(UnusualKind, OfAShortChainIsTheOrderOfSpaceWhereMostRowsLieAcrossItsBox) {
  for (const std::uint32_t n : {256u, 511u, 512u, 2000u}) {
    const std::size_t most = n < 512 ? 13 : 11;
    EXPECT_EQ(kind_of_rows(n, most - 1), "ChainTree") << n;
    EXPECT_EQ(kind_of_rows(n, most), "SphereTree") << n;
  }
  EXPECT_EQ(kind_of_rows(255, 16), "ChainTree") << "few";
}

}  // namespace
}  // namespace catena
