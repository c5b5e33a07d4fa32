// The motion of a rope as physics, and as a test of the variants that find its contacts.
#include "catena/core/motion/rope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "catena/core/motion/knot.h"
#include "catena/core/motion/test_rope.h"
#include "catena/core/strategy/registry.h"

namespace catena::motion {
namespace {

RopeMotion::Start knotted(std::uint32_t n) {
  RopeMotion::Start start;
  Random random(1);
  add_knotted_rope(start, n, 1, {}, random);
  return start;
}

/// An arc of a circle at rest, wide enough that no contacts arise while it springs open.
RopeMotion::Start bow(std::uint32_t n, double radius) {
  const double turn = 2 * std::asin(0.5 / radius);
  RopeMotion::Start start;
  start.first = {0, n};
  for (std::uint32_t i = 0; i < n; ++i)
    start.position.push_back({radius * std::cos(turn * i), radius * std::sin(turn * i), 0});
  start.velocity.resize(n);
  return start;
}

constexpr RopeSettings free_rope{.stretching = 100, .pull = 0, .drag = 0};

TEST(FreeRope, LosesEnergyToNoLessThanTheOrderOfTheIntegrator) {
  double before = 0, kinetic = 0;
  for (const double dt : {0.04, 0.02, 0.01}) {
    RopeMotion motion = rope(free_rope, bow(21, 15));
    const EnergyBalance start = motion.energy();
    double error = 0;
    for (int k = 0; k < std::lround(8 / dt); ++k) {
      ASSERT_TRUE(motion.step(dt));
      error = std::max(error, std::abs(motion.energy().error()));
      kinetic = std::max(kinetic, motion.energy().kinetic);
    }
    EXPECT_TRUE(motion.contacts().empty());
    if (before != 0) {
      EXPECT_GT(before / error, 3.4) << dt;
    }
    EXPECT_GT(kinetic, 0.3 * start.initial) << "it swings";
    before = error;
  }
}

Vec3 momentum(const RopeMotion& motion) {
  const auto v = motion.velocities();
  Vec3 sum{};
  for (std::size_t i = 0; i < v.size(); ++i) sum = sum + (i == 0 || i + 1 == v.size() ? 0.5 : 1.0) * v[i];
  return sum;
}

TEST(FreeRope, KeepsItsMomentumThroughContacts) {
  RopeSettings settings;
  settings.drag = 0;  // the two pulls cancel
  RopeMotion motion = rope(settings, knotted(90));
  const Vec3 before = momentum(motion);
  std::size_t contacts = 0;
  for (int k = 0; k < 60; ++k) {
    ASSERT_TRUE(motion.step(0.5));
    contacts += motion.contacts().size();
    EXPECT_LT(length(momentum(motion) - before), 1e-9);
    double strain = 0;
    const auto now = motion.positions();
    for (std::size_t i = 1; i < now.size(); ++i)
      strain = std::max(strain, std::abs(length(now[i] - now[i - 1]) / settings.spacing - 1));
    EXPECT_NEAR(motion.greatest_strain(), strain, 1e-15);
  }
  EXPECT_GT(contacts, 20u);
}

TEST(FreeRope, FeelsNoContactsWhenThereAreNone) {
  RopeSettings soft = free_rope, hard = free_rope;
  soft.contact = 0, hard.contact = 1e6;
  RopeMotion a = rope(soft, bow(21, 15)), b = rope(hard, bow(21, 15));
  for (int k = 0; k < 50; ++k) {
    ASSERT_TRUE(a.step(0.1) && b.step(0.1));
    EXPECT_EQ(b.energy().contact, 0);
  }
  EXPECT_TRUE(std::ranges::equal(a.chain().spheres(), b.chain().spheres()));
}

TEST(PulledRope, StretchesByThePullOverTheStiffness) {
  for (const double stiffness : {1e2, 1e4, 1e6, 1e9}) {
    RopeSettings settings;
    settings.stretching = stiffness;
    RopeMotion motion = rope(settings, knotted(80));
    double greatest = 0;
    for (int k = 0; k < 120; ++k) {
      ASSERT_TRUE(motion.step(0.5)) << stiffness << " step " << k;
      greatest = std::max(greatest, motion.greatest_strain());
    }
    EXPECT_GT(greatest, 0.9 / stiffness);
    // As the knot closes, the ends, 40 radii at a speed below 1, are stopped within a few steps.
    EXPECT_LT(greatest, 50 / stiffness);
  }
}

struct Ran {
  std::vector<Sphere> end;
  std::size_t contacts_at_end = 0;
  double deepest = 0, error = 0;
};

Ran run(RopeMotion motion, double duration, double dt) {
  Ran ran;
  double work = 0;
  for (int k = 0; k < std::lround(duration / dt); ++k) {
    EXPECT_TRUE(motion.step(dt));
    ran.deepest = std::max(ran.deepest, motion.deepest_penetration());
    ran.error = std::max(ran.error, std::abs(motion.energy().error()));
    work = std::max(work, motion.energy().work);
  }
  ran.error /= work;
  ran.end.assign(motion.chain().spheres().begin(), motion.chain().spheres().end());
  ran.contacts_at_end = motion.contacts().size();
  return ran;
}

TEST(PulledRope, TightensItsKnotAndDoesNotPassThroughItself) {
  const Ran ran = run(rope({}, knotted(80)), 60, 0.125);
  EXPECT_GE(ran.contacts_at_end, 10u);
  EXPECT_LT(ran.deepest, 0.12);
  EXPECT_LT(ran.error, 0.06);
}

TEST(PulledRope, MovesTheSameBitsWithEveryExactVariant) {
  const Ran expected = run(rope({}, knotted(80)), 60, 0.5);
  ASSERT_GE(expected.contacts_at_end, 5u);
  for (const VariantInfo& info : StrategyRegistry::instance().variants()) {
    if (info.unavailable || info.on_device() || !info.exact)
      continue;
    EXPECT_EQ(run(rope({}, knotted(80), StrategyRegistry::instance().make(info.name)), 60, 0.5).end,
              expected.end)
        << info.name;
  }
}

/// Bugs in a variant, as the motion sees them.
class Forgetful final : public Variant {
 public:
  explicit Forgetful(std::size_t keep_one_in) : keep_one_in_(keep_one_in) {}
  void build(const Chain& chain) override { whole_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    whole_->find(chain, request, found);
    std::size_t k = 0;
    std::erase_if(found.pairs, [&](const Pair&) { return k++ % keep_one_in_ != 0; });
  }
  Timings timings() const override { return {}; }

 private:
  std::size_t keep_one_in_;
  std::unique_ptr<Variant> whole_ = StrategyRegistry::instance().make("CPU1");
};

TEST(PulledRope, ShowsContactsThatAVariantDrops) {
  const auto with = [](std::size_t keep_one_in) {
    return run(RopeMotion({}, knotted(80), stored, std::make_unique<Forgetful>(keep_one_in)), 60, 0.25);
  };
  const Ran all = with(1), few = with(8), expected = run(rope({}, knotted(80)), 60, 0.25);
  EXPECT_EQ(all.end, expected.end);
  EXPECT_GT(few.deepest, 2 * all.deepest);
  EXPECT_GT(few.error, 2 * all.error);
}

TEST(RopeMotion, StaysWhereItWasWhenItCannotGoOn) {
  const auto short_of_room = [](const Vec3& p) {
    const auto far = static_cast<float>(p.x * 1e37);  // the ends overflow once they are 34 radii out
    return Sphere{far, static_cast<float>(p.y), static_cast<float>(p.z), 1};
  };
  RopeSettings settings;
  settings.pull = 100;
  RopeMotion motion(settings, knotted(80), short_of_room, StrategyRegistry::instance().make("CPU1"));
  std::vector<Vec3> before;
  bool moved = true;
  for (int k = 0; k < 500 && moved; ++k) {
    before = motion.positions();
    moved = motion.step(0.5);
  }
  EXPECT_FALSE(moved);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(length(motion.positions()[i] - before[i]), 0);
}

TEST(RopeMotion, TakesRopesOfAnyLength) {
  for (const std::uint32_t n : {0u, 1u, 2u, 3u, 7u, 40u}) {
    RopeMotion motion = rope({}, knotted(n));
    for (int k = 0; k < 5; ++k) EXPECT_TRUE(motion.step(0.5)) << n;
    EXPECT_EQ(motion.chain().size(), n);
  }
}

TEST(OverhandKnot, HasItsSpacingAndIsLoose) {
  for (const double spacing : {0.3, 1.0, 1.6}) {
    const auto points = overhand_knot(150, spacing);
    ASSERT_EQ(points.size(), 150u);
    double nearest = 1e9;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) {
        EXPECT_NEAR(length(points[i] - points[i - 1]), spacing, 1e-13);
      }
      for (std::size_t j = i + 1; j < points.size(); ++j)
        if (static_cast<double>(j - i) * spacing > 8)
          nearest = std::min(nearest, length(points[i] - points[j]));
    }
    EXPECT_GT(nearest, 2.5);
  }
}

/// However long it is, what leads into the knot and out of it lies straight along x.
TEST(OverhandKnot, HasStraightEnds) {
  const auto points = overhand_knot(600, 1);
  for (std::size_t i = 0; i < 200; ++i) {
    const Vec3 in = points[i + 1] - points[i], out = points[599 - i] - points[598 - i];
    for (const Vec3& step : {in, out}) EXPECT_NEAR(std::abs(step.x), 1, 1e-6) << i;
  }
}

}  // namespace
}  // namespace catena::motion
