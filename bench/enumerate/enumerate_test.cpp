#include "catena/bench/enumerate/enumerate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "catena/bench/enumerate/judge.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

const float below_half = std::nextafter(0.5f, 0.0f);

std::vector<WalkVerdict> judged(const std::string& variant, const WalkQuestion& question) {
  return judge_walks(*StrategyRegistry::instance().make(variant), question);
}

void expect_published(const std::string& variant, const WalkQuestion& question) {
  const auto verdicts = judged(variant, question);
  EXPECT_EQ(verdicts.size(), static_cast<std::size_t>(question.steps) * (question.contacts ? 2 : 1));
  for (const WalkVerdict& v : verdicts) {
    ASSERT_TRUE(v.published) << v.counts << ", " << v.steps << " steps";
    EXPECT_EQ(v.found, *v.published) << variant << ": " << v.sequence << ", " << v.steps << " steps";
  }
}

/// Every walk, no symmetry, no sphere and no catena: a set of points.
struct Counted {
  std::uint64_t self_avoiding = 0, contact_free = 0, contacts = 0;
};
void count_by_hand(std::vector<std::array<int, 3>>& walk, int dimensions, int steps, std::uint64_t contacts,
                   Counted& sum) {
  if (steps == 0) {
    ++sum.self_avoiding, sum.contact_free += contacts == 0, sum.contacts += contacts;
    return;
  }
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimensions); ++axis)
    for (const int way : {1, -1}) {
      std::array<int, 3> next = walk.back();
      next[axis] += way;
      if (std::ranges::find(walk, next) != walk.end()) continue;
      const auto near = std::ranges::count_if(walk, [&](const auto& p) {
        return std::abs(p[0] - next[0]) + std::abs(p[1] - next[1]) + std::abs(p[2] - next[2]) == 1;
      });
      walk.push_back(next);
      count_by_hand(walk, dimensions, steps - 1, contacts + static_cast<std::uint64_t>(near) - 1, sum);
      walk.pop_back();
    }
}

TEST(PublishedTables, BeginAsASetOfPointsCountsThem) {
  for (const PublishedTable& table : published_tables())
    for (int steps = 0; steps <= (table.dimensions == 2 ? 10 : 7); ++steps) {
      Counted sum;
      std::vector<std::array<int, 3>> walk{{0, 0, 0}};
      count_by_hand(walk, table.dimensions, steps, 0, sum);
      const std::uint64_t counted = table.counts == WalkTable::self_avoiding  ? sum.self_avoiding
                                    : table.counts == WalkTable::contact_free ? sum.contact_free
                                                                              : sum.contacts;
      EXPECT_EQ(table.terms[static_cast<std::size_t>(steps)], counted)
          << table.sequence << ", " << steps << " steps";
    }
}

TEST(PublishedTables, AreEachThereOnce) {
  std::set<std::string> sequences;
  for (const PublishedTable& table : published_tables()) {
    EXPECT_TRUE(sequences.insert(table.sequence).second) << table.sequence;
    EXPECT_EQ(published_table(table.dimensions, table.counts), &table);
  }
  EXPECT_EQ(sequences.size(), 5u);
  EXPECT_EQ(published_table(3, WalkTable::contacts), nullptr);
}

// At the radii where more points begin to touch, and one float beside them.
TEST(PublishedTables, AreOfTheWalksThatARadiusAllows) {
  const auto table = [](float radius) { return WalkQuestion{.radius = radius}.table(); };
  const float adjacent = std::sqrt(0.5f);
  const float below = 2 * double{adjacent} * adjacent < 1 ? adjacent : std::nextafter(adjacent, 0.0f);
  EXPECT_EQ(table(0), WalkTable::self_avoiding);
  EXPECT_EQ(table(std::nextafter(0.5f, 0.0f)), WalkTable::self_avoiding);
  EXPECT_EQ(table(0.5f), WalkTable::contact_free);
  EXPECT_EQ(table(below), WalkTable::contact_free);
  EXPECT_EQ(table(std::nextafter(below, 1.0f)), std::nullopt);
  EXPECT_EQ(table(0.9f), std::nullopt);
}

TEST(Enumerate, FindsThePublishedNumbersOnTheCubicLattice) {
  expect_published("Hybrid", {.dimensions = 3, .radius = below_half, .steps = 8});
  expect_published("Hybrid", {.dimensions = 3, .radius = 0.5f, .steps = 8});
  expect_published("Hybrid", {.dimensions = 3, .radius = 0.7f, .steps = 7});  // diagonals are 1.414 apart
  expect_published("Hybrid", {.dimensions = 3, .radius = 0, .steps = 6});     // points
}

TEST(Enumerate, FindsThePublishedNumbersOnTheSquareLattice) {
  expect_published("Hybrid", {.dimensions = 2, .radius = below_half, .contacts = true, .steps = 12});
  expect_published("Hybrid", {.dimensions = 2, .radius = 0.5f, .steps = 12});
}

TEST(Enumerate, FindsThePublishedNumbersByEveryExactVariant) {
  for (const VariantInfo& info : StrategyRegistry::instance().variants()) {
    if (!info.exact || info.unavailable || info.places.front().on_device()) continue;
    const int steps = info.all_pairs || info.peer ? 3 : 5;
    expect_published(info.name, {.dimensions = 3, .radius = below_half, .steps = steps});
    expect_published(info.name, {.dimensions = 3, .radius = 0.5f, .steps = steps});
  }
}

int squared_distance(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  const int x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/// Every walk on one of the other lattices, no symmetry and no sphere: a set of points, of which none is as
/// near to an earlier one but the last as this squared distance.
std::uint64_t count_by_hand(std::vector<std::array<int, 3>>& walk, const OtherLattice& lattice, int steps,
                            double reach = 0) {
  if (steps == 0) return 1;
  std::uint64_t sum = 0;
  const int way = walk.size() % 2 == 1 ? 1 : -1;
  for (const auto& step : lattice.steps) {
    std::array<int, 3> next = walk.back();
    for (std::size_t axis = 0; axis < 3; ++axis) next[axis] += way * step[axis];
    if (std::any_of(walk.begin(), walk.end() - 1,
                    [&](const auto& p) { return squared_distance(p, next) <= reach; }))
      continue;
    walk.push_back(next);
    sum += count_by_hand(walk, lattice, steps - 1, reach);
    walk.pop_back();
  }
  return sum;
}

TEST(OtherLattices, TablesBeginAsASetOfPointsCountsThem) {
  EXPECT_EQ(other_lattices().size(), 5u);
  EXPECT_EQ(other_lattice("cubic"), nullptr);
  for (const OtherLattice& lattice : other_lattices()) {
    EXPECT_EQ(other_lattice(lattice.name), &lattice);
    EXPECT_EQ(lattice.table.terms[1], lattice.steps.size()) << lattice.name;
    for (const auto& step : lattice.steps)
      EXPECT_EQ(squared_distance(step, {0, 0, 0}), lattice.spacing) << lattice.name;
    for (int steps = 0; lattice.table.terms[static_cast<std::size_t>(steps)] < 100'000; ++steps) {
      std::vector<std::array<int, 3>> walk{{0, 0, 0}};
      EXPECT_EQ(count_by_hand(walk, lattice, steps), lattice.table.terms[static_cast<std::size_t>(steps)])
          << lattice.name << ", " << steps << " steps";
      if (static_cast<std::size_t>(steps) + 1 == lattice.table.terms.size()) break;
    }
  }
}

TEST(Enumerate, FindsThePublishedNumbersOnOtherLattices) {
  for (const OtherLattice& lattice : other_lattices()) {
    int steps = static_cast<int>(lattice.table.terms.size()) - 1;
    while (lattice.table.terms[static_cast<std::size_t>(steps)] > 300'000) --steps;
    for (const float radius : {below_half, 0.25f, 0.0f})
      expect_published("Hybrid", {.radius = radius, .steps = steps, .other = &lattice});
    if (!lattice.isometric) continue;
    EXPECT_FALSE(judged("Hybrid", {.radius = 0.5f, .steps = 2, .other = &lattice}).back().published);
  }
}

// Walks of two steps by the distances of their ends, as any book has them. At .6 steps ends 1 and 2/sqrt(3)
// apart collide, at .75 those of sqrt(2), at .85 of sqrt(8/3), at .9 of sqrt(3), at 1 all.
TEST(Enumerate, TakesRadiiInStepsOfEveryLattice) {
  using Found = std::vector<std::uint64_t>;
  for (const auto& [name, expected] : {std::pair<std::string, Found>{"triangular", {30, 18, 18, 18, 6, 0}},
                                       {"diamond", {12, 12, 12, 0, 0, 0}},
                                       {"body-centred", {56, 32, 32, 8, 8, 0}},
                                       {"face-centred", {132, 84, 60, 60, 12, 0}}}) {
    Found found;
    for (const float radius : {below_half, 0.6f, 0.75f, 0.85f, 0.9f, 1.0f})
      found.push_back(
          judged("CPU1", {.radius = radius, .steps = 2, .other = other_lattice(name)}).back().found);
    EXPECT_EQ(found, expected) << name;
  }
}

// At each radius where more points begin to touch, and one float beside it.
TEST(OtherLattices, HaveTheSamePointsCollideInStepsAndInCoordinates) {
  for (const OtherLattice& lattice : other_lattices())
    for (int squared = 0; squared <= 120; ++squared) {
      const auto tie = static_cast<float>(std::sqrt(squared / (4.0 * lattice.spacing)));
      for (const float steps : {std::nextafter(tie, 0.0f), tie, std::nextafter(tie, 200.0f)}) {
        const double radius = lattice.in_coordinates(steps),
                     reach = 4 * double{steps} * steps * lattice.spacing;
        EXPECT_NEAR(radius, steps * std::sqrt(lattice.spacing), 1e-6 * radius + 1e-40) << lattice.name;
        for (int q = 1; q <= 150; ++q) EXPECT_EQ(4 * radius * radius >= q, reach >= q) << steps << ' ' << q;
        if (steps > 1 || !lattice.isometric) continue;
        std::vector<std::array<int, 3>> walk{{0, 0, 0}};
        EXPECT_EQ(judged("CPU1", {.radius = steps, .steps = 3, .other = &lattice}).back().found,
                  count_by_hand(walk, lattice, 3, reach))
            << lattice.name << ' ' << steps;
      }
    }
}

// In the plane the ends of two of its steps are sqrt(3) apart, as the lattice is embedded sqrt(2).
TEST(Enumerate, RefusesRadiiThatTheHoneycombsPointsDoNotTell) {
  const auto variant = StrategyRegistry::instance().make("CPU1");
  for (const OtherLattice& lattice : other_lattices())
    EXPECT_EQ(lattice.isometric, lattice.name != "honeycomb");
  for (const float radius : {0.5f, 0.8f})
    EXPECT_THROW(
        enumerate_walks(*variant, {.radius = radius, .steps = 2, .other = other_lattice("honeycomb")}),
        InputError);
}

TEST(EnumerateLong, FindsThePublishedNumbersOnOtherLatticesToTheirEnd) {
  for (const OtherLattice& lattice : other_lattices()) {
    const int steps = static_cast<int>(lattice.table.terms.size()) - 1;
    expect_published("Hybrid", {.radius = below_half, .steps = steps, .other = &lattice});
  }
}

TEST(EnumerateLong, FindsThePublishedNumbersToTwelveSteps) {
  expect_published("Hybrid", {.dimensions = 3, .radius = below_half, .steps = 12});
  expect_published("Hybrid", {.dimensions = 3, .radius = 0.5f, .steps = 12});
  expect_published("Hybrid", {.dimensions = 2, .radius = below_half, .contacts = true, .steps = 18});
}

TEST(Enumerate, DecidesAnErratum) {
  const auto verdicts = judged("Hybrid", {.dimensions = 3, .radius = 0.5f, .steps = 10});
  EXPECT_EQ(verdicts.back().found, 2675022u);  // and not 2674926, as was printed in 1961
}

TEST(Enumerate, SeesADifference) {
  WalkVerdict verdict = judged("CPU1", {.dimensions = 2, .radius = 0.5f, .steps = 3}).back();
  EXPECT_FALSE(verdict.differs());
  EXPECT_EQ(to_json(verdict)["agrees"], true);
  ++verdict.found;
  EXPECT_TRUE(verdict.differs());
  EXPECT_EQ(to_json(verdict)["agrees"], false);
  verdict.published.reset();
  EXPECT_FALSE(to_json(verdict).contains("agrees"));  // with nothing
}

TEST(Enumerate, RefusesWhatItCannotCount) {
  const auto variant = StrategyRegistry::instance().make("CPU1");
  EXPECT_THROW(enumerate_walks(*variant, {.steps = 0}), InputError);
  EXPECT_THROW(enumerate_walks(*variant, {.steps = 21}), InputError);
  EXPECT_THROW(enumerate_walks(*variant, {.radius = -1}), InputError);
  EXPECT_THROW(enumerate_walks(*variant, {.radius = std::nanf("")}), InputError);
}

TEST(ChainOfWalks, HasStrandsThatDoNotSeeOneAnother) {
  std::vector<Walk> walks{{}};
  for (int n = 1; n <= 5; ++n) {
    std::vector<Walk> longer;
    for (const Walk& walk : walks)
      for_each_extension(walk, 3, [&](const Walk& one) { longer.push_back(one); });
    walks = longer;
  }
  for (const float radius : {0.25f, 0.5f, 1.0f, 2.5f}) {
    const Chain chain = chain_of_walks(walks, radius);
    ASSERT_EQ(chain.strand_count(), walks.size());
    const auto answer = reference::find(chain);
    EXPECT_FALSE(answer.pairs.empty());
    for (const Pair& p : answer.pairs) EXPECT_EQ(p.i / 6, p.j / 6) << radius;
  }
}

/// Towards one another, as far as they go.
TEST(ChainOfWalks, HasRoomForWalksThatFaceOneAnother) {
  Walk there, back;
  for (int n = 0; n < 5; ++n) there = there.then(0), back = back.then(1);
  std::vector<Walk> walks;
  for (int k = 0; k < 8; ++k) walks.push_back(k % 2 == 0 ? there : back);
  for (const float radius : {0.5f, 1.0f, 2.5f})
    for (const Pair& p : reference::find(chain_of_walks(walks, radius)).pairs)
      EXPECT_EQ(p.i / 6, p.j / 6) << radius;
}

TEST(Enumerate, RefusesRadiiThatSayNothing) {
  const auto variant = StrategyRegistry::instance().make("CPU1");
  for (const float radius : {-0.1f, 100.1f, std::nanf("")}) try {
      enumerate_walks(*variant, {.dimensions = 3, .radius = radius, .steps = 2});
      FAIL() << radius;
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("the radius of a walk is 0 to 100 steps, not "))
          << error.what();
    }
}

TEST(Walks, OfAClassAreAsManyAsItsImages) {
  std::uint64_t images = 0;
  for_each_extension(Walk{}, 3, [&](const Walk& first) {
    for_each_extension(first, 3, [&](const Walk& second) {
      for_each_extension(second, 3, [&](const Walk& third) { images += third.images(3); });
    });
  });
  EXPECT_EQ(images, 6u * 6 * 6);
}

}  // namespace
}  // namespace catena::bench
