// Single steps of a rope, by the formulas of its integrator.
#include <gtest/gtest.h>

#include <algorithm>

#include "catena/core/motion/contact.h"
#include "catena/core/motion/knot.h"
#include "catena/core/motion/rod.h"
#include "catena/core/motion/rope.h"
#include "catena/core/motion/test_rope.h"
#include "catena/core/strategy/registry.h"

namespace catena::motion {
namespace {

/// A straight rope at rest in itself, that moves along.
RopeMotion::Start gliding(std::uint32_t n, double spacing, double speed) {
  RopeMotion::Start start;
  for (std::uint32_t i = 0; i < n; ++i) start.position.push_back({spacing * i, 0, 0});
  start.velocity.assign(n, {0, speed, 0});
  start.first = {0, n};
  return start;
}

TEST(RopeMotion, EndsHaveHalfTheMassOfASphereAndASingleSphereAllOfIt) {
  constexpr double speed = 0.25;
  for (const double spacing : {0.5, 1.0, 2.0})
    for (const std::uint32_t n : {1u, 2u, 3u, 10u}) {
      const RopeMotion motion = rope({.spacing = spacing}, gliding(n, spacing, speed));
      const double mass = spacing * (n == 1 ? 1 : n - 1);
      EXPECT_NEAR(motion.energy().kinetic, mass * speed * speed / 2, 1e-15) << n << " at " << spacing;
      EXPECT_EQ(motion.energy().initial, motion.energy().kinetic) << n << " at " << spacing;
    }
}

/// Two ropes of a sphere each, which stand for the length that they are apart along theirs.
TEST(RopeMotion, RepelsByTheLengthsThatCross) {
  constexpr double depth = 0.25;
  for (const double spacing : {0.5, 1.0, 2.0}) {
    const RopeMotion motion = rope({.contact = 50, .spacing = spacing},
                                   {{{0, 0, 0}, {0, 2 - depth, 0}}, std::vector<Vec3>(2), {0, 1, 2}});
    EXPECT_DOUBLE_EQ(motion.energy().contact, 50 * spacing * spacing * depth * depth / 2);
    EXPECT_DOUBLE_EQ(motion.deepest_penetration(), depth);
  }
}

/// However far off the solution is: mass times acceleration is the load less the drag and the slopes of the
/// energies, where the step ends.
TEST(RopeMotion, SolvesTheEquationOfAStep) {
  const RopeSettings settings{.stretching = 1e3, .spacing = 0.8};
  constexpr std::uint32_t n = 12;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const double h : {0.1, 1.0, 10.0, 100.0}) {
      Random random(seed);
      RopeMotion::Start start = gliding(n, settings.spacing, 0.1);
      for (Vec3& p : start.position) p = p + 0.6 * random.cube();
      RopeMotion motion = rope(settings, start);
      const std::vector<Pair> pairs(motion.contacts().begin(), motion.contacts().end());
      ASSERT_TRUE(motion.step(h)) << seed << ' ' << h;
      const std::vector<Vec3> moved = motion.positions();
      Coordinates x(3 * n), force(3 * n);
      for (std::uint32_t i = 0; i < n; ++i) {
        const Vec3 v = (1 / h) * (moved[i] - start.position[i]);
        const Vec3 a = (1 / h) * (v - start.velocity[i]) + settings.drag * v;
        const double mass = settings.spacing * (i == 0 || i + 1 == n ? 0.5 : 1);
        const double load = settings.pull * (i == 0 ? -1 : i + 1 == n ? 1 : 0);
        node(x, i) = Eigen::Vector3d(moved[i].x, moved[i].y, moved[i].z);
        node(force, i) = mass * Eigen::Vector3d(a.x, a.y, a.z) - Eigen::Vector3d(load, 0, 0);
      }
      Derivatives energies;
      energies.reset(3 * n);
      Rods({settings.stretching, settings.bending, settings.spacing}, {0, n}).add_derivatives(x, energies);
      ContactResponse{settings.contact * settings.spacing * settings.spacing, 2}.add_derivatives(x, pairs,
                                                                                                 energies);
      EXPECT_LT((force + energies.gradient).lpNorm<Eigen::Infinity>(), 1e-9) << seed << ' ' << h;
    }
}

// A sphere alone in a drag d: backward Euler leaves v / (1 + d h) of its speed, BDF2 (4 v1 - v0) / 3 over
// 1 + 2 d h / 3.
TEST(RopeMotion, BeginsAnewWithBackwardEulerWhereTheStepChanges) {
  constexpr double drag = 0.3, speed = 0.5;
  const auto after = [&](std::initializer_list<double> steps) {
    RopeMotion motion = rope({.pull = 0, .drag = drag}, gliding(1, 1, speed));
    for (const double h : steps) EXPECT_TRUE(motion.step(h));
    return motion;
  };
  const auto euler = [&](double v, double h) { return v / (1 + drag * h); };
  const auto bdf2 = [&](double v0, double v1, double h) { return (4 * v1 - v0) / 3 / (1 + 2 * drag * h / 3); };
  const double one = euler(speed, 0.5), two = bdf2(speed, one, 0.5);
  EXPECT_NEAR(after({0.5}).velocities()[0].y, one, 1e-12);
  EXPECT_NEAR(after({0.5, 0.5}).velocities()[0].y, two, 1e-12);
  EXPECT_NEAR(after({0.5, 0.25}).velocities()[0].y, euler(one, 0.25), 1e-12);
  EXPECT_NEAR(after({0.5, 0.75}).velocities()[0].y, euler(one, 0.75), 1e-12);
  EXPECT_NEAR(after({0.5, 0.25, 0.25}).velocities()[0].y, bdf2(one, euler(one, 0.25), 0.25), 1e-12);
  // What the drag takes in a step is the mean of what it takes at both ends.
  EXPECT_NEAR(after({0.5}).energy().dissipated, 0.5 * drag * (speed * speed + one * one) / 2, 1e-12);
  EXPECT_NEAR(after({0.5, 0.5}).energy().dissipated,
              0.5 * drag * (speed * speed + 2 * one * one + two * two) / 2, 1e-12);
}

TEST(RopeMotion, HasANeighbourOnEitherSideHoweverFarItIs) {
  EXPECT_EQ(rope_neighbours(10).window, 1u);
  EXPECT_EQ(rope_neighbours(3.2).window, 1u);
  EXPECT_EQ(rope_neighbours(1).window, 3u);
  EXPECT_EQ(rope_neighbours(0.1).window, 31u);
}

/// Finds what another does, in the opposite order.
class Backwards final : public Variant {
 public:
  void build(const Chain& chain) override { whole_->build(chain); }
  void update(const Chain& chain, const Moved&) override { ++updates, whole_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    whole_->find(chain, request, found);
    std::ranges::reverse(found.pairs);
  }
  Timings timings() const override { return {}; }

  static inline int updates = 0;

 private:
  std::unique_ptr<Variant> whole_ = StrategyRegistry::instance().make("CPU1");
};

TEST(RopeMotion, DoesNotDependOnTheOrderOfThePairsAndAddsUpWhatFindingThemTook) {
  RopeMotion::Start start;
  Random random(1);
  add_knotted_rope(start, 80, 1, {}, random);
  RopeMotion one = rope({}, start), other = rope({}, start, std::make_unique<Backwards>());
  std::size_t several = 0;
  double ms = one.find_ms();
  EXPECT_GT(ms, 0);
  Backwards::updates = 0;
  for (int k = 0; k < 100; ++k) {
    ASSERT_TRUE(one.step(0.5) && other.step(0.5));
    EXPECT_TRUE(std::ranges::equal(one.chain().spheres(), other.chain().spheres())) << k;
    EXPECT_TRUE(std::ranges::is_sorted(other.contacts())) << k;
    EXPECT_TRUE(std::ranges::equal(one.contacts(), other.contacts())) << k;
    several += one.contacts().size() > 2;
    EXPECT_GT(one.find_ms(), ms) << k;
    ms = one.find_ms();
  }
  EXPECT_EQ(Backwards::updates, 100);
  EXPECT_GT(several, 10u);
}

}  // namespace
}  // namespace catena::motion
