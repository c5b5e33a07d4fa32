#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "catena/properties/generators/family.h"
#include "catena/properties/generators/mutate.h"
#include "catena/properties/giants.h"
#include "catena/reference/all_pairs.h"

// What each family of chains is there for comes up among its draws: one that went astray would be missed by
// no search that is right.
namespace catena::properties {
namespace {

using Kind = std::function<bool(const Chain&)>;

bool any(const Chain& chain, bool (*of)(const Sphere&)) { return std::ranges::any_of(chain.spheres(), of); }

Kind strand_of(std::uint32_t spheres) {
  return [=](const Chain& c) {
    const auto& first = c.strands().first;
    for (std::size_t s = 0; s + 1 < first.size(); ++s)
      if (first.size() > 2 && first[s + 1] - first[s] == spheres) return true;
    return false;
  };
}
bool same_place(const Sphere& a, const Sphere& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
Kind same_places(bool like) {
  return [=](const Chain& c) {
    for (std::uint32_t i = 1; i < c.size(); ++i)
      if (same_place(c[i - 1], c[i]) && (c[i - 1].radius == c[i].radius) == like) return true;
    return false;
  };
}
Kind window(std::uint32_t (*of)(std::uint32_t n)) {
  return [=](const Chain& c) { return c.size() > 9 && c.exclusion().window == of(c.size()); };
}
Kind factor(double of) {
  return [=](const Chain& c) { return c.exclusion().factor == of; };
}
Kind spheres(std::uint32_t n) {
  return [=](const Chain& c) { return c.size() == n; };
}
double tightest(const Chain& c) { return reference::all_pairs(c).tightest.margin; }

/// The spheres on both sides of a bystander, which is 1000 of the first radius away.
bool touch_along_all_axes(const Chain& c) {
  for (std::uint32_t i = 2; i < c.size(); ++i) {
    const double x = double{c[i].x} - c[i - 2].x, y = double{c[i].y} - c[i - 2].y,
                 z = double{c[i].z} - c[i - 2].z, reach = double{c[i].radius} + c[i - 2].radius;
    if (c[i - 1].x != 1000 * c[0].radius) continue;
    if (x != 0 && y != 0 && z != 0 && x * x + y * y + z * z == reach * reach) return true;
  }
  return false;
}

struct Made {
  const char *family, *what;
  Kind kind;
};
const std::vector<Made> made{
    {"strands", "five strands", [](const Chain& c) { return c.strand_count() == 5; }},
    {"strands", "some closed, some open",
     [](const Chain& c) {
       const auto& closed = c.strands().closed;
       return std::ranges::count(closed, 1) > 0 && std::ranges::count(closed, 0) > 0;
     }},
    {"strands", "five strands, none of them empty",
     [](const Chain& c) {
       return c.strand_count() == 5 &&
              std::ranges::adjacent_find(c.strands().first) == c.strands().first.end();
     }},
    {"strands", "an empty strand", strand_of(0)},
    {"strands", "a strand of one", strand_of(1)},
    {"strands", "a strand of three", strand_of(3)},
    {"windows", "half of the chain", window([](std::uint32_t n) { return n / 2; })},
    {"windows", "one less", window([](std::uint32_t n) { return n / 2 - 1; })},
    {"windows", "one more", window([](std::uint32_t n) { return n / 2 + 1; })},
    {"windows", "all of the chain", window([](std::uint32_t n) { return n; })},
    {"windows", "the greatest number", window([](std::uint32_t) { return ~0u; })},
    {"arcs", "what a tube can bend", factor(1.5707963267948966)},
    {"arcs", "next to nothing", factor(1e-300)},
    {"arcs", "everything", factor(1e300)},
    {"rules", "joints among strands",
     [](const Chain& c) { return c.strand_count() > 1 && !c.exclusion().extra_pairs.empty(); }},
    {"rules", "joints under an arc window",
     [](const Chain& c) {
       return c.exclusion().rule == Exclusion::Rule::arc_window && !c.exclusion().extra_pairs.empty();
     }},
    {"far", "all of it beyond 2^20",
     [](const Chain& c) {
       return c.size() > 1 &&
              std::ranges::all_of(c.spheres(), [](const Sphere& s) { return std::abs(s.x) > 0x1p20f; });
     }},
    {"denormal", "the smallest numbers",
     [](const Chain& c) {
       return any(c,
                  [](const Sphere& s) { return std::abs(s.x) == std::numeric_limits<float>::denorm_min(); });
     }},
    {"denormal", "radii below the normal range",
     [](const Chain& c) {
       return any(
           c, [](const Sphere& s) { return s.radius > 0 && s.radius < std::numeric_limits<float>::min(); });
     }},
    {"limits", "minus zero",
     [](const Chain& c) { return any(c, [](const Sphere& s) { return s.x == 0 && std::signbit(s.x); }); }},
    {"limits", "a radius of minus zero",
     [](const Chain& c) {
       return any(c, [](const Sphere& s) { return s.radius == 0 && std::signbit(s.radius); });
     }},
    {"limits", "the greatest number",
     [](const Chain& c) {
       return any(c, [](const Sphere& s) { return s.radius == std::numeric_limits<float>::max(); });
     }},
    {"nested", "unlike radii about one place",
     [](const Chain& c) { return c.size() > 1 && c[0].radius == 1024 && same_place(c[0], c[1]); }},
    {"nested", "touching from within",
     [](const Chain& c) { return c.size() > 1 && !same_place(c[0], c[1]); }},
    {"coincident", "like radii at one place", same_places(true)},
    {"coincident", "unlike radii at one place", same_places(false)},
    {"sizes", "383", spheres(383)},
    {"sizes", "384", spheres(384)},
    {"sizes", "385", spheres(385)},
    {"sizes", "65", spheres(65)},
    {"corner", "in no order",
     [](const Chain& c) {  // behind what lies at the corner itself
       return c.size() > 10 && c.size() < 40 &&
              !std::ranges::is_sorted(c.spheres().subspan(5), {}, &Sphere::x);
     }},
    {"touching", "exactly, by steps along all axes", touch_along_all_axes},
    {"lattice", "smaller than whole numbers",
     [](const Chain& c) {
       return any(c, [](const Sphere& s) { return s.x != 0 && std::abs(s.x) < 0x1p-30f; });
     }},
    {"lattice", "larger than whole numbers",
     [](const Chain& c) { return any(c, [](const Sphere& s) { return std::abs(s.x) > 0x1p30f; }); }},
    {"touching", "a bystander",
     [](const Chain& c) { return any(c, [](const Sphere& s) { return s.x == 1000; }); }},
    {"touching", "a tie", [](const Chain& c) { return c.size() < 60 && tightest(c) == 0; }},
    {"ulps", "all but a tie",
     [](const Chain& c) { return c.size() < 60 && tightest(c) > 0 && tightest(c) < 0x1p-20; }},
};

TEST(Families, MakeWhatTheyAreThereFor) {
  for (const Made& of : made) {
    const Family family = FamilyRegistry::instance().family(of.family);
    bool seen = false;
    for (std::uint64_t seed = 0; seed < 3000 && !seen; ++seed) {
      Dice dice(seed);
      seen = of.kind(family.draw(dice, std::string(of.family) == "sizes" ? 400 : 60).chain());
    }
    EXPECT_TRUE(seen) << of.family << ": " << of.what;
  }
}

TEST(Mutation, ChangesTheRuleTooAndGrowsNoChainPastItsSize) {
  const Chain plain(std::vector<Sphere>(12, Sphere{0, 0, 0, 1}));
  std::size_t strands = 0, windows = 0, arcs = 0, joints = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Dice dice(seed);
    const Chain chain = mutate(plain, dice, 12);
    EXPECT_LE(chain.size(), 12u);
    EXPECT_LE(mutate(plain, dice, 5).size(), 5u);
    strands += chain.strand_count() > 1, windows += chain.exclusion().window > 1;
    arcs += chain.exclusion().rule == Exclusion::Rule::arc_window,
        joints += !chain.exclusion().extra_pairs.empty();
  }
  for (const std::size_t times : {strands, windows, arcs, joints}) EXPECT_GT(times, 10u);
}

/// Of two spheres, of which one lies in the other.
TEST(Mutation, PutsASphereToTouchFromWithinAndMovesOneByAPartOfRadii) {
  const Chain plain(std::vector<Sphere>{{0, 0, 0, 8}, {1, 0, 0, 2}});
  std::size_t touching = 0, moved = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Dice dice(seed);
    const Chain chain = mutate(plain, dice, 2);
    if (chain.size() < 2) continue;
    touching += chain[1] == Sphere{1, 0, 0, 7};
    moved += std::abs(chain[0].y) > 0.1f && std::abs(chain[0].y) < 16;
  }
  EXPECT_GT(touching, 10u);
  EXPECT_GT(moved, 10u);
}

/// Pairs and joints on both sides of 2^16, and across it.
TEST(Giants, HavePairsAndJointsOnBothSidesOfTheLastNumberOf16Bits) {
  constexpr std::uint32_t past = 1u << 16;
  const auto sides = [](const auto& pairs) {
    std::array<bool, 3> seen{};
    for (const Pair& p : pairs) seen[p.j < past ? 0 : p.i < past ? 1 : 2] = true;
    return std::ranges::count(seen, true);
  };
  std::ptrdiff_t pairs = 0, joints = 0;
  for (const Case& giant : giants()) {
    EXPECT_GT(giant.chain.size(), past);
    pairs = std::max(pairs, sides(giant.exact.pairs)),
    joints = std::max(joints, sides(giant.chain.exclusion().extra_pairs));
  }
  EXPECT_GE(pairs, 2);
  EXPECT_GE(joints, 2);
}

}  // namespace
}  // namespace catena::properties
