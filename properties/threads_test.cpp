#include <gtest/gtest.h>

#include <algorithm>

#include "catena/core/scenes/scene.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/suite.h"

namespace catena::properties {
namespace {

/// The property of that name, or null.
std::unique_ptr<Property> property_named(const std::string& name) {
  for (auto& property : PropertyRegistry::instance().make_all())
    if (property->name() == name) return std::move(property);
  return nullptr;
}

/// What ThreadSanitizer is to see of every host variant: several threads on one chain, and after them others.
TEST(Threads, AnyNumberGivesTheSameOnEveryFamily) {
  const auto property = property_named("any number of threads");
  ASSERT_NE(property, nullptr);
  auto subjects = Subject::available();
  std::erase_if(subjects, [&](const Subject& s) { return !property->applies_to(s); });
  EXPECT_GE(subjects.size(), 10u) << "variants that take a number of threads";
  for (const Subject& subject : subjects) {
    const auto variant = subject.make();
    std::uint64_t seed = 0;
    for (const Family& family : FamilyRegistry::instance().families()) {
      Dice dice(++seed);
      const Case test = Case::of(generate(family, dice, 48));
      const auto failure = property->check(subject, *variant, test);
      EXPECT_FALSE(failure) << subject.info.name << ", " << family.name << ": " << *failure;
    }
  }
}

/// Long enough for many ranges of work, crowded and not, with levels of radii.
TEST(Threads, ShareOutLargeChains) {
  Collisions expected, found;
  for (const std::string scene :
       {"yarn:n=20000", "path1:n=40000", "points:n=20000,share=0.7", "stretched:n=20000,octaves=3"}) {
    const Chain chain = SceneRegistry::instance().open(scene)->frame(scene.starts_with("path1") ? 28 : 0);
    const auto single = StrategyRegistry::instance().make("aCPU2+Dual");
    single->build(chain);
    single->find(chain, {}, expected);
    ASSERT_GT(expected.pair_count, 10u) << scene;
    sort(expected.pairs);
    for (const char* const name :
         {"Hybrid(threads=2)", "Hybrid(threads=3,crowd=2)", "Hybrid(threads=3,crowd=100000)",
          "Hybrid(threads=3,crowd=0,dense=1e6)", "Hybrid(threads=3,crowd=0,dense=0)", "Grid(threads=3,cells=wide)", "Grid(threads=3,cells=narrow)",
          "SphereTree(threads=3)"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      for (int again = 0; again < 3; ++again) {
        variant->build(chain);
        variant->find(chain, {}, found);
        sort(found.pairs);
        ASSERT_EQ(found.pairs, expected.pairs) << name << ", " << scene;
        ASSERT_EQ(found.count, expected.count) << name << ", " << scene;
      }
    }
  }
}

}  // namespace
}  // namespace catena::properties
