#include "catena/core/input/tube_loss.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "catena/core/input/test_crooked.h"

namespace catena {
namespace {

/// How deep in the tube between two spheres a point lies, at most: 0 and below is outside.
double depth_between(const Vec3& p, const Sphere& a, const Sphere& b) {
  double deepest = -1e300;
  for (int k = 0; k <= 64; ++k) {
    const double t = k / 64.0;
    const Vec3 c = centre(a) + t * (centre(b) - centre(a));
    deepest = std::max(deepest, a.radius + t * (double{b.radius} - a.radius) - length(p - c));
  }
  return deepest;
}

TEST(TubeLoss, IsTheDipOnAStraightTube) {
  const std::vector<Sphere> rod{{0, 0, 0, 2}, {0.5F, 0, 0, 2}, {0.75F, 0, 0, 2}, {1, 0, 0, 2}};
  EXPECT_NEAR(tube_loss(rod), 2 - std::sqrt(4 - 0.25), 1e-12);
}

TEST(TubeLoss, IsTheChordErrorToo) {
  const std::vector<Sphere> bent{{-0.5F, 0, 0, 2}, {0, 0.25F, 0, 2}, {0.5F, 0, 0, 2}};
  EXPECT_NEAR(tube_loss(bent), 0.25 + 2 - std::sqrt(4 - 0.25), 1e-12);
  const std::vector<Sphere> swollen{{-0.5F, 0, 0, 2}, {0, 0, 0, 2.25F}, {0.5F, 0, 0, 2}};
  EXPECT_NEAR(tube_loss(swollen), tube_loss(bent), 1e-12);
}

// The tube between the ends ends with them: what lies beyond, or where there is nothing between, sticks out.
TEST(TubeLoss, IsOfWhatSticksOutBeyondTheEnds) {
  const auto at = [](float x) { return Sphere{x, 0, 0, 1}; };
  for (const float out : {0.25f, 0.5f}) {
    EXPECT_NEAR(tube_loss(std::vector<Sphere>{at(0), at(1 + out), at(1)}),
                tube_loss(std::vector<Sphere>{at(0), at(1)}) + out, 1e-9);
    EXPECT_NEAR(tube_loss(std::vector<Sphere>{at(0), at(-out), at(1)}),
                tube_loss(std::vector<Sphere>{at(0), at(1)}) + out, 1e-9);
    EXPECT_NEAR(tube_loss(std::vector<Sphere>{at(0), at(out), at(0)}), out, 1e-9);
  }
}

TEST(TubeLoss, IsAllOfAGap) {
  EXPECT_EQ(tube_loss(std::array{Sphere{0, 0, 0, 1}, Sphere{2, 0, 0, 1}}), 1);
  EXPECT_EQ(tube_loss(std::array{Sphere{0, 0, 0, 1}, Sphere{9, 0, 0, 5}, Sphere{50, 0, 0, 1}}), 5);
  EXPECT_EQ(tube_loss(std::array{Sphere{0, 0, 0, 1}, Sphere{std::nextafter(2.0f, 0.0f), 0, 0, 1}}), 1)
      << "nearly";
  EXPECT_EQ(tube_loss(std::array{Sphere{0, 0, 0, 1}, Sphere{9, 0, 0, 5}, Sphere{1, 0, 0, 1}}), 5)
      << "no more than that";
  EXPECT_EQ(tube_loss(std::array{Sphere{0, 0, 0, 0}, Sphere{0, 0, 0, 0}}), 0);
  // One that holds the other leaves nothing uncovered.
  EXPECT_LT(tube_loss(std::array{Sphere{0, 0, 0, 5}, Sphere{1, 0, 0, 1}}), 1e-12);
}

using Loss = double (*)(std::span<const Sphere>);

/// Points of the tube that are deeper than what is said to be lost lie in a kept sphere; and what is said is
/// no more than three times the depth of the deepest point that does not. What is wrong, if anything.
std::string fault_of(Loss loss_of) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> one(0, 1);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 40; ++round) {
    const auto spheres = crooked(random, 3 + static_cast<std::uint32_t>(6 * one(random)));
    const double loss = loss_of(spheres);
    double uncovered = 0;
    for (int sample = 0; sample < 20000; ++sample) {
      const std::size_t k = std::min<std::size_t>(
          static_cast<std::size_t>(one(random) * (spheres.size() - 1)), spheres.size() - 2);
      const double t = one(random);
      const Vec3 c = centre(spheres[k]) + t * (centre(spheres[k + 1]) - centre(spheres[k]));
      Vec3 aside{normal(random), normal(random), normal(random)};
      const double radius = spheres[k].radius + t * (double{spheres[k + 1].radius} - spheres[k].radius);
      const Vec3 p = c + radius * (1 - 0.2 * one(random) * one(random)) / length(aside) * aside;
      if (length(p - centre(spheres.front())) <= spheres.front().radius ||
          length(p - centre(spheres.back())) <= spheres.back().radius)
        continue;
      for (std::size_t j = 0; j + 1 < spheres.size(); ++j)
        uncovered = std::max(uncovered, depth_between(p, spheres[j], spheres[j + 1]));
    }
    if (uncovered > loss) return "a point is lost that is deeper than what is said to be";
    if (3 * uncovered < loss) return "more is said to be lost than three times what is";
  }
  return "";
}

TEST(TubeLoss, HoldsForEveryPointOfTheTube) { EXPECT_EQ(fault_of(tube_loss), ""); }

/// A loss as tube_loss has it, of which a part is forgotten.
struct MutantLoss {
  const char* forgets;
  Loss loss;
};

double dip_of(const Sphere& a, const Sphere& b, double radius) {
  const double step = length(centre(b) - centre(a)), taper = double{a.radius} - b.radius;
  return radius - std::sqrt(std::max(0.0, radius * radius - std::max(0.0, step * step - taper * taper) / 4));
}
double chord_error(std::span<const Sphere> spheres) {
  const Sphere &a = spheres.front(), &b = spheres.back();
  const Vec3 chord = centre(b) - centre(a);
  double excess = 0;
  for (const Sphere& s : spheres) {
    const Vec3 out = centre(s) - centre(a);
    const double along = std::clamp(dot(out, chord) / dot(chord, chord), 0.0, 1.0);
    const double swell = s.radius - (a.radius + along * (double{b.radius} - a.radius));
    excess = std::max(excess, length(out - along * chord) + swell);
  }
  return excess;
}
double least_radius(std::span<const Sphere> s) { return std::min(s.front().radius, s.back().radius); }

/// The mutants of a museum: the statement that holds for tube_loss kills each, and not what they are made
/// from.
TEST(TubeLoss, ItsMutantsDie) {
  EXPECT_EQ(fault_of([](std::span<const Sphere> s) {
              return chord_error(s) + dip_of(s.front(), s.back(), least_radius(s)) + 1e-12;
            }),
            "")
      << "what the mutants are made from";
  for (const MutantLoss& mutant : {
           MutantLoss{"the dip between neighbours", [](std::span<const Sphere> s) { return chord_error(s); }},
           MutantLoss{"the chord error",
                      [](std::span<const Sphere> s) { return dip_of(s.front(), s.back(), least_radius(s)); }},
           MutantLoss{"that two spheres dip from either side",
                      [](std::span<const Sphere> s) {
                        return chord_error(s) + dip_of(s.front(), s.back(), least_radius(s)) / 2;
                      }},
           MutantLoss{"all spheres but the middle one",
                      [](std::span<const Sphere> s) {
                        const std::array three{s.front(), s[s.size() / 2], s.back()};
                        return chord_error(three) + dip_of(s.front(), s.back(), least_radius(s));
                      }},
           MutantLoss{"to stay near what is lost",
                      [](std::span<const Sphere> s) { return 0.05 + 4 * tube_loss(s); }},
       })
    EXPECT_NE(fault_of(mutant.loss), "") << "survives: a loss that forgets " << mutant.forgets;
}

}  // namespace
}  // namespace catena
