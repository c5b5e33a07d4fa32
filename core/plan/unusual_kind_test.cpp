#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "catena/core/grid/grid_kernels.h"
#include "catena/core/input/input.h"
#include "catena/core/plan/find.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/forced_target.h"

namespace catena {
namespace {

/// So many spheres in a box of these sides, anywhere.
std::vector<Sphere> anywhere(std::uint32_t n, float x, float y, float z, float radius) {
  std::mt19937 dice(n);
  const auto below = [&](float side) { return std::uniform_real_distribution<float>(0, side)(dice); };
  std::vector<Sphere> spheres;
  while (spheres.size() < n) spheres.push_back({below(x), below(y), below(z), radius});
  return spheres;
}

TEST(UnusualKind, IsToldByTheExtentAndItsVariantGivesTheAnswerOfAllPairs) {
  std::vector<std::string> taken;
  for (const char* input :
       {"yarn:n=4000", "path1:n=700", "mixed_radii:n=2000,decades=30", "mixed_radii:n=700,decades=60",
        "mixed_radii:n=300,jump=1e20", "subnormal:n=700", "yarn:n=700,radius=1e-41", "serpentine:n=1000",
        "cluster:n=700,shells=140", "yarn:n=7000", "tight_knot:n=1500", "hair:n=1000,strands=1000",
        "hair:n=2000,strands=4", "winding:n=1000", "lattice:n=1000"}) {
    const Chain chain = open_input(input).animation->frame(0);
    const UnusualKind* const kind = UnusualKind::of(chain.view());
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
    EXPECT_TRUE(planned->answered_by().starts_with(kind->variant)) << input << ": " << planned->answered_by();
    const std::string reason = planned->plan().front().reason;
    EXPECT_NE(reason.find(kind->reason), std::string::npos) << reason;
  }
  EXPECT_EQ(taken[0], "Grid") << "that fill their box";
  EXPECT_EQ(taken[1], "ChainTree");
  EXPECT_EQ(taken[2], "ChainTree") << "a horn that grows slowly";
  EXPECT_EQ(taken[3], "SphereTree") << "a horn";
  EXPECT_EQ(taken[5], "ChainTree") << "out of range, in a box that is mostly empty";
  EXPECT_EQ(taken[7], "ChainTree") << "crowded, but any search finds as much near each sphere";
  EXPECT_EQ(taken[13], "SphereTree") << "crowded";
  EXPECT_EQ(taken[14], "ChainTree") << "in rows that fill the box";
  EXPECT_EQ(taken[10], "ChainTree") << "a smooth tube";
  EXPECT_EQ(taken[9], "Grid") << "crowded, and its parts lie among one another";
  EXPECT_EQ(taken[8], "SphereTree") << "of unlike radii, whose parts do not lie apart";
  EXPECT_EQ(taken[11], "Grid") << "strands shorter than a block, anywhere";
  EXPECT_EQ(taken[12], "ChainTree") << "long strands";
  for (const char* usual :
       {"winding:n=30000", "lattice:n=7000", "tight_knot:n=30000", "mixed_radii:n=3000,decades=30",
        "points:n=3000,share=0.7", "lattice:n=3000,scale=1e-30", "cluster:n=30000",
        "far:n=3000,exponent=20,radius=1e24", "smallest:n=3000", "hair:n=3000,radius=1e-41"}) {
    const Chain chain = open_input(usual).animation->frame(0);
    EXPECT_EQ(UnusualKind::of(chain.view()), nullptr) << usual;
  }
  // One speck among crowded spheres does not make the chain's order the better one.
  auto spheres = open_input("yarn:n=3000").animation->frame(0);
  std::vector<Sphere> specked(spheres.spheres().begin(), spheres.spheres().end());
  specked[1000].radius = 1e-25f;
  const Chain chain(specked);
  EXPECT_EQ(UnusualKind::of(chain.view()), nullptr);
  EXPECT_EQ(UnusualKind::of({}), nullptr) << "nothing is known";
  for (const std::uint32_t n : {100u, 3000u}) {
    ChainView unplaced{};
    unplaced.size = n, unplaced.extent = {1, 1, 3 * std::cbrt(n), 0};
    EXPECT_EQ(UnusualKind::of(unplaced), nullptr) << "where they lie is not known";
  }
}

/// Cells are quicker for some kinds where vectors are narrow, a tree of single spheres where they are wide.
TEST(UnusualKind, GoesByTheVectorsWhereBothWouldDo) {
  std::size_t narrow = 0;
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    narrow += !wide_vectors();
    for (const std::uint32_t n : {400u, 1000u, 2000u}) {
      const float side = std::cbrt(2 * static_cast<float>(n));
      const Chain chain(anywhere(n, side, side, side, 0.5f));
      const auto kind = [&](bool frames_follow) {
        return UnusualKind::of(chain.view(), frames_follow)->variant;
      };
      EXPECT_EQ(kind(false), wide_vectors() ? "SphereTree" : "Grid") << n << ", " << target;
      EXPECT_EQ(kind(true), "SphereTree") << n << ", " << target;
    }
  }
  EXPECT_GT(narrow, 0u);
}

const UnusualKind* unusual(const std::vector<Sphere>& spheres) {
  const Chain chain(spheres);
  return UnusualKind::of(chain.view());
}
std::string kind_of(const std::vector<Sphere>& spheres) { return unusual(spheres)->variant; }

/// Of radius 0 few collide, and a tree of blocks is not worth its while.
TEST(UnusualKind, OfAFewPointsIsToldByTheirOrder) {
  for (const std::uint32_t n : {40u, 300u, 1000u, 2048u}) {
    EXPECT_EQ(kind_of(anywhere(n, 40, 40, 40, 0)), "SphereTree") << n;
    auto path = open_input("walk:n=" + std::to_string(n)).animation->frame(0);
    std::vector<Sphere> points(path.spheres().begin(), path.spheres().end());
    for (Sphere& point : points) point.radius = 0;
    EXPECT_EQ(kind_of(points), "ChainTree") << n;
    points[n / 2] = points[0], points[n / 3] = points[n - 1];
    const Chain chain(points);
    Collisions all;
    const auto every_pair = StrategyRegistry::instance().make("CPU1");
    every_pair->build(chain);
    every_pair->find(chain, {}, all);
    EXPECT_EQ(all.pair_count, 2u) << n;
    EXPECT_EQ(find(chain).count, all.count) << n;
  }
  EXPECT_EQ(unusual(anywhere(2049, 40, 40, 40, 0)), nullptr) << "many";
  EXPECT_EQ(unusual(std::vector<Sphere>(100)), nullptr) << "in one place, as nothing that is known";
}

/// Radii that grow along the chain; but not by a few specks or giants, nor where each part has all radii.
TEST(UnusualKind, OfVeryUnlikeRadiiIsToldByPartsOfTheChain) {
  const auto radii = [](std::uint32_t n, const auto& exponent) {  // of two, of sphere i
    std::vector<Sphere> spheres;
    float x = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto radius = static_cast<float>(std::exp2(exponent(i)));
      x += 1.5f * radius;
      spheres.push_back({x, 0.0f, 0.0f, radius});
    }
    return spheres;
  };
  const auto is_horn = [](const std::vector<Sphere>& spheres) {
    const UnusualKind* const kind = unusual(spheres);
    return kind != nullptr && kind->reason.find("2^60") != std::string::npos;
  };
  EXPECT_EQ(unusual(radii(5000, [](double i) { return 80 * (i / 5000 - 0.5); })), nullptr) << "many";
  for (const std::uint32_t n : {300u, 2000u}) {
    const auto along = [&](double octaves) { return [=](double i) { return octaves * (i / n - 0.5); }; };
    for (const double octaves : {80., -80., 120., 180.})
      EXPECT_EQ(is_horn(radii(n, along(octaves))), n == 300 || octaves == 180) << n << ' ' << octaves;
    EXPECT_FALSE(is_horn(radii(n, along(50)))) << n;
    const auto plain = radii(n, [](double) { return 0; });
    for (const float one : {1e-19f, 1e-30f, 0.0f, 1e19f})
      for (std::uint32_t at = 0; at < n; at += n / 10) {
        auto spheres = plain;
        spheres[at].radius = one;
        EXPECT_FALSE(is_horn(spheres)) << n << ' ' << one << ' ' << at;
      }
    EXPECT_FALSE(is_horn(radii(n, [](std::uint32_t i) { return i % 3 == 0 ? 0 : -80; }))) << n;
    EXPECT_FALSE(is_horn(radii(n, [](std::uint32_t i) { return i * 31 % 97 - 90.0; }))) << n;
    auto specks = radii(n, along(180));
    for (std::uint32_t i = 0; i < n; i += 3) specks[i].radius = 0;
    EXPECT_TRUE(is_horn(specks)) << n;
  }
  std::vector<Sphere> spiral;
  for (int i = 0; i < 2000; ++i) {
    const double size = std::exp2(80 * (i / 2000. - 0.5)), turn = 0.08 * i;
    spiral.push_back({static_cast<float>(size * std::cos(turn)), static_cast<float>(size * std::sin(turn)),
                      static_cast<float>(size / 10), static_cast<float>(size / 20)});
  }
  EXPECT_EQ(kind_of(spiral), "ChainTree") << "that no row sees grow";
}

/// Of a finely sampled tube rows of eight are near many others of it, whose spheres other variants look at
/// one by one.
TEST(UnusualKind, OfAFinelySampledTubeIsTheChainsOrder) {
  const auto tube = [](std::uint32_t n, float step, float radius, float wave) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) {
      const float along = step * static_cast<float>(i);
      spheres.push_back({along, wave * std::sin(along / 10), wave * std::cos(along / 10), radius});
    }
    return spheres;
  };
  for (const std::uint32_t n : {100u, 301u, 600u, 800u, 1500u, 2048u})
    for (const float radius : {0.5f, 1.0f, 2.0f, 4.0f})
      for (const float wave : {0.0f, 2.0f})
        EXPECT_EQ(kind_of(tube(n, 0.1f, radius, wave)), "ChainTree") << n << ' ' << radius << ' ' << wave;
  // As near one another, and any search finds as much: pages of overlapping rows.
  std::vector<Sphere> block;
  for (int i = 0; i < 1728; ++i)
    block.push_back(
        {static_cast<float>(i % 12), static_cast<float>(i / 12 % 12), static_cast<float>(i / 144), 1.5f});
  EXPECT_EQ(kind_of(block), "ChainTree");
  // Not as much, where rows turn: their boxes meet, they do not.
  std::vector<Sphere> wound;
  for (int i = 0; i < 1000; ++i) {
    const double turn = std::sqrt(335.0 * i), out = 0.0095 * turn;
    wound.push_back(
        {static_cast<float>(out * std::cos(turn)), static_cast<float>(out * std::sin(turn)), 0.0f, 1.0f});
  }
  EXPECT_EQ(kind_of(wound), "SphereTree");
}

/// The chain's order alone scales its numbers; in a box that is not empty they tell more by themselves.
TEST(UnusualKind, OfNumbersWhoseSquaresLeaveBinary32IsTheChainsOrderInAnEmptyBox) {
  for (const float scale : {1e-25f, 1e25f}) {
    auto empty = anywhere(700, 30, 30, 30, 0.3f), full = anywhere(700, 3, 3, 3, 0.3f);
    for (auto* spheres : {&empty, &full})
      for (Sphere& s : *spheres) s = {scale * s.x, scale * s.y, scale * s.z, scale * s.radius};
    EXPECT_EQ(kind_of(empty), "ChainTree") << scale;
    EXPECT_EQ(kind_of(full), "SphereTree") << scale;
  }
}

/// What lies anywhere in a box is never searched in the chain's order, however thin or long the box is.
TEST(UnusualKind, OfAFewSpheresThatLieAnywhereIsNotTheChainsOrder) {
  for (const std::uint32_t n : {200u, 700u, 2048u})
    for (const auto& [x, y, z] :
         {std::tuple(30.f, 30.f, 30.f), {100.f, 100.f, 1.f}, {1000.f, 1.f, 1.f}, {3.f, 3.f, 3.f}})
      for (const float radius : {0.01f, 0.3f})
        EXPECT_NE(kind_of(anywhere(n, x, y, z, radius)), "ChainTree")
            << n << ' ' << x << ' ' << z << ' ' << radius;
  auto clusters = anywhere(1000, 1, 1, 1, 0.1f);
  std::mt19937 dice(1);
  for (Sphere& s : clusters) s.x += 1000 * static_cast<float>(dice() % 7);
  EXPECT_NE(kind_of(clusters), "ChainTree") << "clusters, between which the chain jumps";
}

/// Straight or in a wide coil it is; but not where few turns are as near one another as all spheres of a
/// turn.
TEST(UnusualKind, OfAFewSpheresInOrderIsTheChainsOrder) {
  for (const std::uint32_t n : {100u, 300u, 1000u, 2048u}) {
    std::vector<Sphere> straight, coil, flat;
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto t = static_cast<float>(i);
      straight.push_back({t, 0.1f * t, 0, 0.6f});
      coil.push_back({20 * std::cos(t / 20), 20 * std::sin(t / 20), t / 20, 0.6f});
      flat.push_back({3 * std::cos(2.4f * t), 3 * std::sin(2.4f * t), 0.01f * t, 0.2f});
    }
    EXPECT_EQ(kind_of(straight), "ChainTree") << n;
    EXPECT_EQ(kind_of(coil), "ChainTree") << n;
    coil[7].radius *= 2.1f;
    EXPECT_EQ(kind_of(coil), "ChainTree") << n << ", of unlike radii";
    EXPECT_NE(kind_of(flat), "ChainTree") << n;
  }
}

/// Strands side by side, in boxes that meet: the chain's order tells them apart.
TEST(UnusualKind, OfABundleOfStrandsIsTheChainsOrder) {
  for (const std::uint32_t length : {26u, 42u, 63u, 84u, 107u}) {
    std::vector<Sphere> twisted;  // 19 of them, as wires in a cable
    for (int q = -2; q <= 2; ++q)
      for (int r = -2; r <= 2; ++r)
        for (std::uint32_t k = 0; k < length && std::abs(q + r) <= 2; ++k) {
          const double along = 1.2 * k, turn = along / 40, x = 2.1 * (q + r / 2.),
                       y = 2.1 * r * std::sqrt(.75);
          twisted.push_back({static_cast<float>(x * std::cos(turn) - y * std::sin(turn)),
                             static_cast<float>(x * std::sin(turn) + y * std::cos(turn)),
                             static_cast<float>(along), 1});
        }
    EXPECT_EQ(kind_of(twisted), "ChainTree") << length;
  }
  const auto kind_of_hair = [](const char* input) {
    return UnusualKind::of(open_input(input).animation->frame(0).view());
  };
  // Strands of one row each, or a little less or more, and of so many that nodes tell little.
  for (const char* input : {"hair:n=700", "hair:n=800", "hair:n=1100", "hair:n=3300"})
    EXPECT_EQ(kind_of_hair(input)->variant, "ChainTree") << input;
  EXPECT_EQ(kind_of_hair("hair:n=3100"), nullptr);
}

/// At most 6,000 spheres, and single ones by cells from 301 on where they are alike.
TEST(UnusualKind, OfSpheresThatLieAnywhereIsToldByTheirNumberAndRadii) {
  EXPECT_EQ(kind_of(anywhere(300, 30, 30, 30, 0.3f)), "SphereTree");
  EXPECT_EQ(kind_of(anywhere(301, 30, 30, 30, 0.3f)), "Grid");
  EXPECT_EQ(kind_of(anywhere(6000, 30, 30, 30, 0.3f)), "Grid");
  const Chain many(anywhere(6001, 30, 30, 30, 0.3f));
  EXPECT_EQ(UnusualKind::of(many.view()), nullptr);
  const Chain some(anywhere(2049, 30, 30, 30, 0.3f));
  EXPECT_EQ(UnusualKind::of(some.view(), true), nullptr) << "in frames it is looked at once for many";
  EXPECT_EQ(unusual(anywhere(7000, 3, 3, 3, 0.5f)), nullptr) << "more than full";
  EXPECT_EQ(kind_of(anywhere(7000, 20, 20, 20, 0.5f)), "Hybrid") << "that fill their box";
  auto unlike = anywhere(2000, 30, 30, 30, 0.3f);
  unlike[7].radius = 2 * 0.3f;
  EXPECT_EQ(kind_of(unlike), "Grid");
  unlike[7].radius = 0.601f;
  EXPECT_EQ(kind_of(unlike), "SphereTree");
  EXPECT_EQ(kind_of(anywhere(2000, 3, 3, 3, 0.3f)), "SphereTree") << "that fill their box";
  const Chain frames(anywhere(2000, 30, 30, 30, 0.3f));
  EXPECT_EQ(UnusualKind::of(frames.view(), true)->variant, "SphereTree") << "sorted once for several frames";
}

}  // namespace
}  // namespace catena
