// What the scene of the ropes promises beyond what every scene does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"
#include "catena/core/motion/knot.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/test_pairs.h"
#include "catena/core/strategy/test_variant.h"

namespace catena {
namespace {

std::unique_ptr<Animation> open(const std::string& spec) { return SceneRegistry::instance().open(spec); }

bool same(const Chain& a, const Chain& b) { return std::ranges::equal(a.spheres(), b.spheres()); }

std::size_t contacts(const Chain& chain) {
  const auto touching = test::touching_pairs(chain.spheres());
  return static_cast<std::size_t>(
      std::ranges::count_if(touching, [&](const Pair& p) { return !chain.neighbours(p.i, p.j); }));
}

TEST(Rope, IsPulledIntoAKnotThatStays) {
  const auto rope = open("rope:n=80,rope=80,duration=60,frames=13");
  EXPECT_EQ(contacts(rope->frame(0)), 0u);
  for (const std::uint32_t f : {10u, 11u, 12u}) EXPECT_GE(contacts(rope->frame(f)), 5u) << f;
}

TEST(Rope, HasTheSameFramesInWhateverOrderAndFromWhateverExactVariant) {
  const std::string spec = "rope:n=80,rope=80,duration=30,frames=7";
  const auto forward = open(spec), backward = open(spec), other = open(spec + ",variant=CPU1");
  const Chain late = backward->frame(6);
  for (const std::uint32_t f : {0u, 3u, 6u}) {
    EXPECT_TRUE(same(forward->frame(f), backward->frame(f))) << f;
    EXPECT_TRUE(same(forward->frame(f), other->frame(f))) << f;
  }
  EXPECT_FALSE(same(late, backward->frame(5)));
  EXPECT_FALSE(same(late, open(spec + ",seed=2")->frame(6)));
  EXPECT_THROW(forward->frame(7), std::out_of_range);
}

TEST(Rope, RepeatsTwoRopesAndKeepsTheOthersApart) {
  const auto ropes = open("rope:n=430,rope=80,duration=60,frames=3,align=axes");
  const Chain chain = ropes->frame(2);
  ASSERT_EQ(chain.strand_count(), 6u) << "five of 80 and one of 30";
  const auto shape = [&](std::uint32_t i) { return double{chain[i].x} - chain[i / 80 * 80].x; };
  double between_twins = 0;
  for (std::uint32_t i = 0; i < 80; ++i) {
    EXPECT_NEAR(shape(i), shape(160 + i), 1e-4);
    between_twins = std::max(between_twins, std::abs(shape(i) - shape(80 + i)));
  }
  EXPECT_GT(between_twins, 1e-3);
  for (const Pair& p : test::touching_pairs(chain.spheres())) EXPECT_EQ(p.i / 80, p.j / 80);
  const Chain first = ropes->frame(0);
  const std::vector<Vec3> shorter = motion::overhand_knot(30, 1);  // with a knot of its own
  for (std::uint32_t i = 0; i < 30; ++i)
    EXPECT_NEAR(first[400 + i].x - first[400].x, shorter[i].x - shorter[0].x, 1e-4);
}

/// In rows and columns about the origin, each rope as far from the next as another.
TEST(Rope, LaysRopesInASquare) {
  const auto ropes = open("rope:n=320,rope=80,frames=1,align=axes");
  const Chain chain = ropes->frame(0);
  double y = 0, z = 0;
  for (const Sphere& s : chain.spheres()) y += s.y / 320.0, z += s.z / 320.0;
  const auto apart = [&](std::uint32_t a, std::uint32_t b) {
    const Sphere &p = chain[80 * a + 40], &q = chain[80 * b + 40];
    return std::pair(std::round(double{q.y} - p.y), std::round(double{q.z} - p.z));
  };
  const double room = motion::knot_room;
  EXPECT_EQ(apart(0, 1), std::pair(room, 0.0));
  EXPECT_EQ(apart(0, 2), std::pair(0.0, room));
  EXPECT_EQ(apart(0, 3), std::pair(room, room));
  double first_y = 0, first_z = 0;  // of a knot about its root, which it may lie aside of
  for (const Vec3& p : motion::overhand_knot(80, 1)) first_y += p.y / 80, first_z += p.z / 80;
  EXPECT_NEAR(y, first_y, 1e-3);
  EXPECT_NEAR(z, first_z, 1e-3);
  const Chain three = open("rope:n=240,rope=80,frames=1,align=axes")->frame(0);
  EXPECT_LT(three[80].z - three[0].z, 1) << "the last row is not full";
}

/// Its spheres stay as far apart as they are asked to be, and know their neighbours by it.
TEST(Rope, HasItsSpacing) {
  const auto rope = open("rope:n=60,rope=60,spacing=0.5,frames=3,duration=2,align=axes");
  for (std::uint32_t f = 0; f < 3; ++f) {
    const Chain chain = rope->frame(f);
    EXPECT_EQ(chain.exclusion().window, motion::rope_neighbours(0.5).window);
    for (std::uint32_t i = 1; i < chain.size(); ++i) {
      const Sphere &s = chain[i - 1], &t = chain[i];
      EXPECT_NEAR(std::hypot(t.x - s.x, t.y - s.y, t.z - s.z), 0.5, 1e-3) << f << ' ' << i;
    }
  }
}

/// A variant that loses contacts lets the rope go where another would not.
TEST(Rope, AnswersToTheContactsThatItsVariantFinds) {
  const std::string spec = "rope:n=80,rope=80,duration=60,frames=3";
  EXPECT_FALSE(
      same(open(spec)->frame(2), open(spec + ",variant=mutant:grid-truncates-toward-zero")->frame(2)));
}

TEST(Rope, SaysWhatIsWrong) {
  const auto refusal = [](const std::string& spec, std::uint32_t frame) -> std::string {
    try {
      open(spec)->frame(frame);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refusal("rope:variant=CPU7", 0).find("CPU1"), std::string::npos);
  EXPECT_NE(refusal("rope:step=0", 0).find("step=0"), std::string::npos);
  const std::string diverges = refusal("rope:n=120,step=1e5,stiffness=1e9", 40);
  EXPECT_NE(diverges.find("lower step=100000"), std::string::npos) << diverges;
  const auto frame = std::stoul(diverges.substr(diverges.find("before frame ") + 13));
  EXPECT_EQ(refusal("rope:n=120,step=1e5,stiffness=1e9", static_cast<std::uint32_t>(frame - 1)), "accepted");
  EXPECT_EQ(refusal("rope:n=120,step=1e5,stiffness=1e9", static_cast<std::uint32_t>(frame)), diverges);
}

/// Contacts as CPU1 finds them, but for one frame in which there is no memory.
class OutOfMemoryOnce final : public Variant {
 public:
  static inline int finds_left = -1;  ///< until then; negative: never
  void build(const Chain& chain) override { found_by_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    if (finds_left >= 0 && finds_left-- == 0) throw std::bad_alloc();
    found_by_->find(chain, request, found);
  }
  Timings timings() const override { return {}; }

 private:
  std::unique_ptr<Variant> found_by_ = StrategyRegistry::instance().make("CPU1");
};

const test::RegisterHidden<OutOfMemoryOnce> out_of_memory_once{
    {.name = "OutOfMemoryOnce", .summary = "as a test asks"}};

/// What a frame is asked for anew after an exception, it is not a longer motion.
TEST(Rope, HasTheSameFramesAfterOneThatCouldNotBeMade) {
  const std::string spec = "rope:n=40,rope=40,duration=12,frames=5";
  const auto right = open(spec), scene = open(spec + ",variant=OutOfMemoryOnce");
  for (const int finds : {0, 1, 4, 9}) {
    OutOfMemoryOnce::finds_left = finds;
    EXPECT_THROW(scene->frame(3), std::bad_alloc) << finds;
    EXPECT_TRUE(same(scene->frame(1), right->frame(1))) << finds;
    EXPECT_TRUE(same(scene->frame(0), right->frame(0))) << finds;
    if (finds == 9) {
      EXPECT_TRUE(same(scene->frame(3), right->frame(3)));
    }
  }
}

}  // namespace
}  // namespace catena
