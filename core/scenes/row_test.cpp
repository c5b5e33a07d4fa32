#include "catena/core/scenes/row.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/scenes/scene.h"

namespace catena {
namespace {

/// Every scene of the program, but for the one whose spheres move one another.
std::vector<std::string> scenes_of_stretches() {
  std::vector<std::string> names;
  for (const SceneInfo& scene : SceneRegistry::instance().scenes())
    if (scene.name != "rope") names.push_back(scene.name);
  return names;
}

std::vector<std::string> every_setting(const std::string& name) {
  std::vector<std::string> specs{name + ":n=0", name + ":n=1", name + ":n=2", name + ":n=257"};
  for (const SceneInfo& scene : SceneRegistry::instance().scenes())
    for (const std::string& setting : scene.settings)
      if (scene.name == name) specs.push_back(fmt::format("{}:n=300,{}", name, setting));
  for (const std::string more :
       {"hair:n=40,strands=64", "hair:n=500,strands=7", "lattice:n=90,ulps=3,seed=9",
        "serpentine:side=6,strands=rods", "path1:n=3000", "path2:n=3000,spacing=0.4"})
    if (more.starts_with(name + ":")) specs.push_back(more);
  return specs;
}

class Stretch : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, Stretch, testing::ValuesIn(scenes_of_stretches()),
                         [](const auto& test) { return test.param; });

void expect_stretches_of(const Animation& scene, std::uint32_t f) {
  const Chain whole = scene.frame(f);
  const auto part = scene.in_stretches(f);
  ASSERT_TRUE(part);
  ASSERT_EQ(part->size, whole.size());
  const std::uint32_t n = whole.size();
  const Chain joined(part->spheres(0, n), part->strands, part->exclusion);
  EXPECT_EQ(joined.strands().first, whole.strands().first);
  EXPECT_EQ(joined.strands().closed, whole.strands().closed);
  EXPECT_EQ(joined.exclusion().rule, whole.exclusion().rule);
  EXPECT_EQ(joined.exclusion().window, whole.exclusion().window);
  EXPECT_EQ(joined.exclusion().factor, whole.exclusion().factor);
  for (const auto& [first, end] : {std::pair{0u, n},
                                   {n / 3, n / 2},
                                   {n, n},
                                   {n / 2, n},
                                   {n - n / 7, n - n / 8},
                                   {0u, 0u},
                                   {n / 5, n / 5},
                                   {n - std::min(n, 1u), n}})
    EXPECT_TRUE(std::ranges::equal(part->spheres(first, end), whole.spheres().subspan(first, end - first)))
        << "frame " << f << ", spheres " << first << " to " << end << " of " << n;
}

/// Whatever stretch is asked for, it is bit for bit what the whole chain has there.
TEST_P(Stretch, IsCutOutOfTheWholeChain) {
  for (const std::string& spec : every_setting(GetParam())) {
    SCOPED_TRACE(spec);
    const auto scene = SceneRegistry::instance().open(spec);
    for (const std::uint32_t f : {0u, scene->frames() / 2, scene->frames() - 1})
      expect_stretches_of(*scene, f);
  }
}

TEST(Row, RefusesWhatItDoesNotHave) {
  const Row row = Row::by_number(5, [](std::uint32_t i) { return Sphere{float(i), 0, 0, 1}; });
  EXPECT_EQ(row.spheres(2, 5).size(), 3u);
  EXPECT_THROW(row.spheres(2, 6), std::out_of_range);
  EXPECT_THROW(row.spheres(3, 2), std::out_of_range);
}

/// By number nothing is made but what is asked for; by steps nothing after it.
TEST(Row, MakesNoMoreThanItMust) {
  std::vector<std::uint32_t> made;
  const auto at = [&](std::uint32_t i) {
    made.push_back(i);
    return Sphere{float(i), 0, 0, 1};
  };
  Row::by_number(100, at).spheres(40, 43);
  EXPECT_EQ(made, (std::vector<std::uint32_t>{40, 41, 42}));
  made.clear();
  Row::by_steps(100, [&] { return [&, i = 0u]() mutable { return at(i++); }; }).spheres(1, 4);
  EXPECT_EQ(made, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace catena
