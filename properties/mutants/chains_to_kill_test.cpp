#include "catena/properties/mutants/chains_to_kill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace catena::properties::testing {
namespace {

using Spheres = std::vector<Sphere>;

Spheres tangle(std::uint32_t n, std::uint32_t seed, float scale = 1, float offset = 0) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<float>(random() % 20001) / 10000 - 1; };
  Spheres spheres;
  float x = 0, y = 0, z = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back(
        {x * scale + offset, y * scale - offset, z * scale + offset, scale * (0.5f + unit() / 4)});
    x += unit(), y += unit(), z += unit();
  }
  return spheres;
}

/// Through the integer lattice and back: unit steps, radius 1/2, so that lattice neighbours touch exactly.
Spheres lattice(std::uint32_t n, float scale, float nudge = 0) {
  Spheres spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t row = i / 5, layer = row / 5;
    const auto back = [](std::uint32_t at, bool turned) { return static_cast<float>(turned ? 4 - at : at); };
    spheres.push_back({scale * back(i % 5, row % 2), scale * back(row % 5, layer % 2),
                       scale * static_cast<float>(layer), scale * 0.5f});
    if (i % 3 == 0) spheres.back().radius = std::nextafter(spheres.back().radius, nudge * 1e30f);
  }
  return spheres;
}

/// Pairs that touch in one direction but for a part of 2^-80 of it in another: apart by less than binary64
/// can see.
Spheres nearly_touching(std::uint32_t n) {
  Spheres spheres;
  for (std::uint32_t i = 0; i < n; ++i)
    spheres.push_back({static_cast<float>(8 * (i % 7)) + (i % 2 ? 2.0f : 0.0f), i % 2 ? 0x1p-80f : 0.0f,
                       static_cast<float>(i / 14 * 8), 1});
  return spheres;
}

/// Radii of every size, at decimal places, around touching: where rounding decides.
Spheres grazing(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  Spheres spheres;
  const auto part = [&] { return static_cast<float>(random() % 1000) / 997; };
  for (std::uint32_t i = 0; i < n; i += 3) {
    const Sphere a{part() * 50, part() * 50, part() * 50, part()};
    const float dx = part(), dy = part(), dz = part(), d = std::sqrt(dx * dx + dy * dy + dz * dz);
    spheres.push_back(a);
    spheres.push_back({part() * 50, part() * 50, part() * 50, 0});
    spheres.push_back({a.x + dx, a.y + dy, a.z + dz, std::max(0.0f, d - a.radius)});
  }
  return spheres;
}

/// Each sphere halves the way to the origin along the next axis, and four lie in it: a tree over Morton codes
/// has a level a sphere. All overlap all.
Spheres into_a_corner(std::uint32_t n) {
  Spheres spheres{{1, 1, 1, 4}};
  float gap[3] = {1, 1, 1};
  for (std::uint32_t i = 0; i + 5 < n; ++i) {
    gap[i % 3] /= 2;
    spheres.push_back({gap[0], gap[1], gap[2], 4});
  }
  spheres.insert(spheres.end(), 4, Sphere{0, 0, 0, 4});
  return spheres;
}

/// Pairs along one axis, each sphere's radius the least that still reaches its partner: all that a box may
/// lose is one rounding.
Spheres reaching(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto part = [&] { return static_cast<float>(random() % 1000) / 99.7f; };
  Spheres spheres;
  for (std::uint32_t i = 0; i < n; i += 3) {
    const float y = 100 * static_cast<float>(i);
    const Sphere a{part(), y, 0, part()}, between{0, y + 50, 0, 0};
    Sphere b{a.x + a.radius + part(), y, 0, 0};
    const double missing = double{b.x} - a.x - a.radius;
    b.radius = std::max(0.0f, static_cast<float>(missing));
    if (b.radius < missing) b.radius = std::nextafter(b.radius, 1e30f);
    spheres.insert(spheres.end(), {a, between, b});
  }
  return spheres;
}

/// Beads on a line across the axes; some reach the next but one by less than binary32 can see.
Spheres beads(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto part = [&] { return 1 + static_cast<float>(random() % 1000) / 997; };
  const float x = part(), y = part(), z = part(), step = std::sqrt(x * x + y * y + z * z);
  Spheres spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto t = static_cast<float>(i);
    spheres.push_back({t * x, t * y, t * z, 0.75f * step});
    if (i % 16 != 13) continue;
    Sphere& before = spheres[i - 2];
    before.radius = step;
    float& radius = spheres[i].radius;
    const double distance = std::hypot(double{spheres[i].x} - before.x, double{spheres[i].y} - before.y,
                                       double{spheres[i].z} - before.z);
    radius = static_cast<float>(distance - before.radius);
    if (double{radius} + before.radius < distance) radius = std::nextafter(radius, 1e30f);
  }
  return spheres;
}

/// Two heaps of coincident spheres in neighbouring Morton cells, one end of the box far away.
Spheres two_heaps(std::uint32_t n) {
  Spheres spheres{{0, 0, 0, 1}, {0x1p21f, 0x1p21f, 0x1p21f, 1}};
  for (std::uint32_t i = 2; i < n; ++i)
    spheres.push_back({1000.5f, 1000.5f, i < n / 2 ? 1000.5f : 1001.5f, 0.25f});
  return spheres;
}

Spheres mixed_scales(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto number = [&] {
    return std::ldexp(static_cast<float>(random() % 1000) / 1000, static_cast<int>(random() % 270) - 148);
  };
  Spheres spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({-number(), number(), number(), number()});
  return spheres;
}

/// Large spheres, and so many specks on them that these are of a level of their own in a grid. They touch large
/// ones in all directions, from all parts of cells.
Spheres specks(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<float>(random() % 20001) / 10000 - 1; };
  Spheres spheres;
  Sphere large{};
  for (std::uint32_t i = 0; i < n; ++i) {
    if (i % 8 == 0) spheres.push_back(large = {2 * unit(), 2 * unit(), 2 * unit(), 0.5f});
    const float x = unit(), y = unit(), z = unit(), on = 0.53f / std::sqrt(x * x + y * y + z * z + 0x1p-20f);
    spheres.push_back({large.x + on * x, large.y + on * y, large.z + on * z, 0.03f + unit() / 64});
  }
  return spheres;
}

/// Equal steps, so that arc lengths and windows meet exactly; every sphere reaches many others.
Spheres ring(std::uint32_t n) {
  Spheres spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t half = n / 2, k = i < half ? i : n - 1 - i;
    spheres.push_back({static_cast<float>(k), i < half ? 0.0f : 1.0f, 0, 1});
  }
  return spheres;
}

using Rule = std::function<Chain(Spheres)>;

std::vector<std::pair<std::string, Rule>> rules() {
  const auto thirds = [](const Spheres& s) {
    const auto n = static_cast<std::uint32_t>(s.size());
    return std::vector<std::uint32_t>{0, n / 3, n / 2, n};
  };
  return {{"open", [](Spheres s) { return Chain(std::move(s)); }},
          {"closed",
           [](Spheres s) {
             const auto n = static_cast<std::uint32_t>(s.size());
             return Chain(std::move(s), Strands::one_closed(n), Exclusion::index(2));
           }},
          {"strands",
           [=](Spheres s) {
             const Strands strands{thirds(s), {0, 1, 0}};
             return Chain(std::move(s), strands, Exclusion::index(1));
           }},
          {"arc", [](Spheres s) { return Chain(std::move(s), {}, Exclusion::arc(1)); }},
          {"closed arc",
           [](Spheres s) {
             const auto n = static_cast<std::uint32_t>(s.size());
             return Chain(std::move(s), Strands::one_closed(n), Exclusion::arc(1.5));
           }},
          {"joints", [](Spheres s) {
             Exclusion exclusion = Exclusion::index(1);
             const auto n = static_cast<std::uint32_t>(s.size());
             for (std::uint32_t i = 0; i + 2 < n; i += 2) exclusion.extra_pairs.push_back({i, i + 2});
             return Chain(std::move(s), {}, exclusion);
           }}};
}

}  // namespace

ChainsToKill chains_to_kill() {
  ChainsToKill result;
  const auto add = [&](const std::string& name, Spheres spheres, const Rule& rule = rules()[0].second) {
    result.chains.push_back({name, rule(std::move(spheres))});
  };
  for (std::uint32_t n : {1u, 2u, 3u, 5u, 9u, 17u, 33u, 50u}) add("tangle", tangle(n, n));
  for (std::uint32_t n : {2u, 3u, 4u}) add("coincident", Spheres(n, Sphere{1, 2, 3, 1}));
  for (const auto& [name, rule] : rules()) {
    add("ring, " + name, ring(40), rule);
    add("tangle, " + name, tangle(3, 2), rule);
    add("tangle, " + name, tangle(60, 3), rule);
    add("lattice, " + name, lattice(60, 1), rule);
    add("coincident, " + name, Spheres(20, Sphere{1, -2, 3, 1}), rule);
  }
  for (const float scale : {1.0f, 0x1p-74f, 0x1p-140f, 0x1p-20f, 0x1p62f, 0x1p110f}) {
    add("lattice, scaled", lattice(50, scale));
    add("lattice, wider", lattice(50, scale, 1));
    add("lattice, narrower", lattice(50, scale, -1));
    add("tangle, scaled", tangle(50, 5, scale));
  }
  for (const float offset : {1e3f, 1e5f, 6452399.0f, 1e7f, 1e20f})
    add("tangle, far", tangle(60, 6, 1, offset));
  add("nearly touching", nearly_touching(56));
  for (std::uint32_t seed = 0; seed < 8; ++seed) add("grazing", grazing(60, seed));
  for (std::uint32_t seed = 0; seed < 4; ++seed) add("mixed scales", mixed_scales(40, seed));
  add("corner", into_a_corner(64));
  for (std::uint32_t seed = 0; seed < 3; ++seed) add("reaching", reaching(60, seed));
  for (std::uint32_t seed = 0; seed < 8; ++seed) add("beads", beads(48, seed));
  add("two heaps", two_heaps(64));
  add("points", Spheres(30, Sphere{0, 0, 0, 0}));
  result.small = result.chains.size();

  add("specks", specks(600, 1));
  for (std::uint32_t n : {127u, 128u, 129u, 257u}) add("tangle", tangle(n, n));
  add("coincident", Spheres(200, Sphere{1, 2, 3, 1}));
  add("coincident", Spheres(400, Sphere{1, 2, 3, 0}));
  for (std::uint32_t n : {383u, 384u, 385u, 513u, 769u, 1025u, 1537u}) add("tangle", tangle(n, n));
  return result;
}

TEST(ChainsToKill, AreManyAndSmallOnesComeFirst) {
  const ChainsToKill all = chains_to_kill();
  EXPECT_GE(all.small, 60u);
  for (std::size_t k = 0; k < all.small; ++k)
    EXPECT_LE(all.chains[k].chain.size(), 64u) << all.chains[k].name;
}

}  // namespace catena::properties::testing
