#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/parts/local_chain.h"
#include "catena/core/parts/partition.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/testing/every_family.h"
#include "catena/reference/reference.h"

/// A search part after part is one more exact variant: every property on every family of chains, in few and
/// many parts, of short and long groups, in chain order and by space, with parts that stay and parts that
/// take turns.
namespace catena::properties {
namespace {

class PartsProperties : public testing::TestWithParam<std::string> {};

TEST_P(PartsProperties, HoldOnEveryFamily) { expect_every_property(GetParam(), 2000, 2); }

INSTANTIATE_TEST_SUITE_P(Host, PartsProperties,
                         testing::Values("Parts", "Parts(parts=1)", "Parts(parts=2,order=chain,group=1)",
                                         "Parts(parts=3,order=space,group=1)",
                                         "Parts(parts=7,order=space,group=3)",
                                         "Parts(parts=5,order=chain,group=4,searches=8)",
                                         "Parts(parts=11,group=2,searches=1)",
                                         "Parts(parts=5,order=chain,group=1,searches=1)",
                                         "Parts(parts=2,group=1,searches=1,room=24)"),
                         [](const auto& of) { return fmt::format("Case{}", of.index); });

Chain scene(const std::string& spec) {
  const Input input = open_input(spec);
  return input.animation->frame(input.animation->frames() / 2);
}

void expect_same(Collisions found, reference::Answer exact, const std::string& input) {
  ASSERT_FALSE(exact.pairs.empty()) << input;
  sort(found.pairs);
  sort(exact.pairs);
  EXPECT_EQ(found.pairs, exact.pairs) << input;
  EXPECT_EQ(found.count, exact.count) << input;
  EXPECT_EQ(found.pair_count, exact.pair_count) << input;
}

/// As a device is told of them that knows neighbours by number: in a part whose spheres are not in the order
/// of the chain, too.
TEST(Parts, NumbersSayNeighboursAsTheWholeDoes) {
  for (const std::uint32_t window : {1u, 2u, 5u}) {
    const Chain whole(std::vector<Sphere>(400, Sphere{0, 0, 0, 1}), {}, Exclusion::index(window));
    const parts::PartRanges ranges{.before = {{300, 310}, {350, 351}},
                                   .own = {{3, 5}, {6, 140}},
                                   .after = {{0, 2}, {141, 143}, {160, 161}}};
    const parts::LocalChain part(whole, ranges, parts::LocalChain::Neighbours::by_number);
    ASSERT_TRUE(part.by_number());
    std::vector<std::uint32_t> id;
    for (std::uint32_t k = 0; k < part.size(); ++k) id.push_back(part.id(k));
    ExclusionView rule = whole.view().exclusion;
    rule.id = id.data();
    rule.ascends_from = part.own().begin, rule.ascends_to = part.own().end;
    std::uint32_t neighbours = 0;
    for (std::uint32_t i = 0; i < part.size(); ++i)
      for (std::uint32_t j = 0; j < part.size(); ++j)
        if (i != j) {
          EXPECT_EQ(rule.neighbours(i, j, 1, 1), whole.neighbours(id[i], id[j])) << id[i] << ' ' << id[j];
          neighbours += rule.neighbours(i, j, 1, 1);
        }
    EXPECT_GT(neighbours, part.size());
  }
  const Chain strands(std::vector<Sphere>(100, Sphere{0, 0, 0, 1}), {{0, 50, 100}, {0, 0}},
                      Exclusion::index(1)),
      joined(std::vector<Sphere>(100, Sphere{0, 0, 0, 1}), {},
             {Exclusion::Rule::index_window, 1, 0, {Pair{3, 70}}});
  for (const Chain* chain : {&strands, &joined})
    EXPECT_FALSE(parts::LocalChain(*chain, {{}, {{0, 100}}, {}}, parts::LocalChain::Neighbours::by_number)
                     .by_number());
}

std::uint64_t step(const Variant& variant, const std::string& name) {
  for (const WorkDone& done : variant.work())
    if (done.step == name) return done.times;
  ADD_FAILURE() << "no step " << name;
  return 0;
}

/// What the parts are, and not only that they are right: paths stay in chain order with small halos, a ball
/// of yarn is parted by space.
TEST(Parts, ArePartedByWhatIsMeasured) {
  struct Expected {
    const char* input;
    bool in_space;
  };
  for (const auto& [input, in_space] :
       {Expected{"path1:n=40000", false}, Expected{"path2:n=40000", false}, Expected{"yarn:n=40000", true}}) {
    const Chain chain = scene(input);
    const auto variant = StrategyRegistry::instance().make("Parts(parts=4,searches=4)");
    variant->build(chain);
    Collisions found;
    variant->find(chain, {}, found);
    expect_same(found, reference::find(chain), input);
    EXPECT_EQ(step(*variant, "parts"), 4u) << input;
    EXPECT_EQ(step(*variant, "parted by space"), in_space) << input;
    EXPECT_LT(step(*variant, "spheres in halos"), chain.size()) << input;
    if (!in_space) {
      EXPECT_LT(step(*variant, "spheres in halos"), chain.size() / 20) << input;
    }
  }
}

TEST(Parts, HaveAsManyAsTheRoomAsks) {
  const Chain chain = scene("path1:n=100000");
  const auto variant = StrategyRegistry::instance().make("Parts(parts=1,room=10000)");
  variant->build(chain);
  Collisions found;
  variant->find(chain, {}, found);
  const auto exact = reference::find(chain);
  ASSERT_FALSE(exact.pairs.empty());
  expect_same(found, exact, "path1");
  EXPECT_GE(step(*variant, "parts"), 10u);
  EXPECT_GT(step(*variant, "spheres searched for pairs of two parts"), 0u);
  variant->find(chain, {}, found);  // parts that took turns come again
  expect_same(found, exact, "path1 again");
}

/// Eleven are needed: no search is to wait while the others have one more.
TEST(Parts, AreSharedOutEvenlyAmongSearches) {
  const Chain chain = scene("path1:n=100000");
  const auto variant = StrategyRegistry::instance().make("Parts(parts=1,room=9500,searches=4)");
  variant->build(chain);
  Collisions found;
  variant->find(chain, {}, found);
  expect_same(found, reference::find(chain), "path1");
  EXPECT_EQ(step(*variant, "parts"), 12u);
  const auto alone = StrategyRegistry::instance().make("Parts(parts=1,room=30000,searches=1)");
  alone->build(chain);
  alone->find(chain, {}, found);
  expect_same(found, reference::find(chain), "path1");
  EXPECT_EQ(step(*alone, "parts"), 4u);  // three would be more than there is room for
}

/// Half a path and then a ball of yarn that fills the room for pairs of two parts.
TEST(Parts, ComeWithHalosWhereTooMuchTouchesOthers) {
  std::vector<Sphere> spheres;
  const Chain path = scene("path1:n=60000"), yarn = scene("yarn:n=6000");
  for (const Sphere& s : path.spheres()) spheres.push_back(s);
  for (const Sphere& s : yarn.spheres()) spheres.push_back({s.x + 1e4f, s.y, s.z, s.radius});
  const Chain chain(spheres);
  const auto variant = StrategyRegistry::instance().make("Parts(parts=1,room=3000,searches=2)");
  variant->build(chain);
  Collisions found;
  variant->find(chain, {}, found);
  expect_same(found, reference::find(chain), "path and yarn");
  EXPECT_GT(step(*variant, "spheres in halos"), 0u);
}

TEST(Parts, SayWhereThereIsNoRoom) {
  const Chain chain(std::vector<Sphere>(5000, Sphere{1, 2, 3, 4}));  // each touches all others
  const auto variant = StrategyRegistry::instance().make("Parts(parts=1,room=1000)");
  try {
    variant->build(chain);
    FAIL() << "parted what cannot be parted";
  } catch (const CapacityError& error) {
    EXPECT_NE(std::string(error.what()).find("memory of 1000 spheres"), std::string::npos) << error.what();
  }
}

TEST(Parts, ForgetTheChainBeforeOneThatHasNoRoom) {
  const Chain fits = scene("path1:n=5000"), has_none(std::vector<Sphere>(5000, Sphere{1, 2, 3, 4}));
  const auto variant = StrategyRegistry::instance().make("Parts(parts=1,room=1000)");
  Collisions found;
  variant->build(fits);
  variant->find(fits, {}, found);
  expect_same(found, reference::find(fits), "path1");
  EXPECT_THROW(variant->build(has_none), CapacityError);
  EXPECT_THROW(variant->find(fits, {}, found), std::logic_error);
  variant->build(fits);
  variant->find(fits, {}, found);
  expect_same(found, reference::find(fits), "path1 again");
}

TEST(Parts, SayHowTheChainWasSharedOut) {
  struct Expected {
    const char *variant, *says;
    bool left_out;
  };
  const Chain chain = scene("path1:n=3000");
  for (const auto& [name, says, left_out] :
       {Expected{"Parts(parts=1)", "1 part in chain order, each stays where it is", true},
        Expected{"Parts(parts=2,searches=3)", "2 parts in chain order, each stays where it is", false},
        Expected{"Parts(parts=4,searches=1)", "4 parts in chain order, which take turns", false},
        Expected{"Parts(parts=3,order=space,searches=3)", "3 parts by space, each stays where it is", false},
        Expected{"Parts(parts=5,order=space)", "5 parts by space, which take turns", false}}) {
    const auto variant = StrategyRegistry::instance().make(name);
    variant->build(chain);
    Collisions found;
    variant->find(chain, {}, found);
    expect_same(found, reference::find(chain), name);
    const Plan plan = variant->plan();
    ASSERT_EQ(plan.size(), 1u);
    EXPECT_EQ(plan[0].reason, says) << name;
    EXPECT_EQ(plan[0].left_out, left_out) << name;
    EXPECT_TRUE(plan[0].actual_ms) << name;
  }
}

/// A row whose end comes back beside its begin: by space where more than an eighth is near the other part.
TEST(Parts, ComeByTheOrderThatHasTheSmallerHalos) {
  constexpr std::uint32_t n = 8192;
  const auto hook = [](std::uint32_t beside) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) {
      const bool back = i >= n - beside;
      spheres.push_back({static_cast<float>(back ? n - i : i), back ? 2.f : 0, 0, 1});
    }
    return Chain(std::move(spheres));
  };
  const Team team(Parameters("test", {Team::threads_parameter()}, "threads=1"));
  const parts::PartitionOptions measured{};
  for (const auto& [beside, in_space] : {std::pair{n / 32, false}, std::pair{43 * 32u, true}}) {
    const parts::Partition partition = parts::part_chain(hook(beside), 2, measured, team);
    EXPECT_EQ(partition.in_space, in_space) << beside;
    std::uint64_t in_halos = 0;
    for (const parts::PartRanges& part : partition.parts)
      in_halos += parts::spheres_in(part.before) + parts::spheres_in(part.after);
    EXPECT_GT(in_halos, 0u) << beside;
    EXPECT_LE(in_halos, n / 8) << beside;
  }
}

/// Where each part touches all others in either order.
TEST(Parts, ComeInChainOrderWhereNoHalosAreSmallerBySpace) {
  constexpr std::uint32_t n = 1024;
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i), 0, 0, n});
  const Chain chain(std::move(spheres));
  const Team team(Parameters("test", {Team::threads_parameter()}, "threads=1"));
  const parts::Partition partition = parts::part_chain(chain, 4, {}, team);
  EXPECT_FALSE(partition.in_space);
  EXPECT_EQ(partition.halo_share(), 3);
  EXPECT_EQ(partition.greatest(), n);
}

TEST(Parts, HaveHalosOnBothSides) {
  parts::Partition partition;
  EXPECT_EQ(partition.halo_share(), 0);
  partition.parts = {{.before = {}, .own = {{0, 6}}, .after = {{6, 7}, {8, 9}}},
                     {.before = {{1, 6}}, .own = {{6, 10}}, .after = {}}};
  EXPECT_EQ(partition.halo_share(), 0.7);
  EXPECT_EQ(partition.greatest(), 9u);
}

TEST(Parts, CountPairsPastTheLimit) {
  const Chain chain = scene("yarn:n=3000");
  const auto exact = reference::find(chain);
  const auto variant = StrategyRegistry::instance().make("Parts(parts=4)");
  variant->build(chain);
  Collisions found;
  variant->find(chain, {}, found);
  ASSERT_FALSE(found.count.empty());
  try {
    variant->find(chain, {.pair_limit = exact.pair_count / 4}, found);
    FAIL() << "kept more pairs than the limit";
  } catch (const PairLimitExceeded& exceeded) {
    EXPECT_EQ(exceeded.found(), exact.pair_count);
    EXPECT_TRUE(found.pairs.empty());
    EXPECT_TRUE(found.count.empty());  // what was found before is no answer
  }
  variant->find(chain, {.want = Request::Want::counts}, found);
  EXPECT_EQ(found.count, exact.count);
}

}  // namespace
}  // namespace catena::properties
