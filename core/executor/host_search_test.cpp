#include "catena/core/executor/host_search.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <new>
#include <thread>
#include <vector>

#include "catena/core/error.h"

namespace catena {
namespace {

Chain row(std::uint32_t size) { return Chain(std::vector<Sphere>(size, Sphere{0, 0, 0, 1})); }

/// Reports one pair, does what it is told while it builds and searches.
class OnePair final : public HostSearch {
 public:
  std::function<void()> constructing = [] {}, searching = [] {};
  int constructed_again = 0;
  mutable int told = 0;

  Accounting evidence() const override { return Accounting::each_pair; }

 private:
  Plan steps() const override { return ++told, Plan{{"step", true, "reason"}}; }
  void construct(const ChainView&) override { constructing(); }
  void construct_again(const ChainView&) override { constructing(), ++constructed_again; }
  void search(const ChainView&, PairCollector& collector) override {
    searching();
    collector.lane(0).collide(0, 2);
  }
  void search_with_evidence(const ChainView&, PairCollector::Lane& lane, EvidenceSink& sink) override {
    sink.tested(0, 2);
    lane.collide(0, 2);
  }
};

struct Tested final : EvidenceSink {
  void discarded(std::uint32_t, std::uint32_t) override {}
  void tested(std::uint32_t i, std::uint32_t j) override { pairs.push_back({i, j}); }
  void excluded(std::uint32_t, std::uint32_t) override {}
  std::vector<Pair> pairs;
};

TEST(HostSearch, HasNothingBuiltWhereABuildFails) {
  OnePair variant;
  Collisions found;
  EXPECT_THROW(variant.find(row(3), {}, found), std::logic_error);
  EXPECT_THROW(variant.find(row(0), {}, found), std::logic_error) << "no spheres are a chain, too";
  variant.build(row(3));
  variant.find(row(3), {}, found);
  EXPECT_EQ(found.pairs, (std::vector<Pair>{{0, 2}}));
  EXPECT_THROW(variant.find(row(4), {}, found), std::logic_error);
  variant.constructing = [] { throw std::runtime_error("no memory"); };
  EXPECT_THROW(variant.build(row(3)), std::runtime_error);
  EXPECT_THROW(variant.find(row(3), {}, found), std::logic_error);
}

/// Its steps are told of parts that belong together, or not at all.
TEST(HostSearch, TellsNoStepsOfWhatFailed) {
  OnePair variant;
  EXPECT_TRUE(variant.plan().empty());
  variant.build(row(3));
  EXPECT_EQ(variant.plan().size(), 1u);
  variant.constructing = [] { throw std::bad_alloc(); };
  EXPECT_THROW(variant.build(row(3)), std::bad_alloc);
  EXPECT_TRUE(variant.plan().empty());
  EXPECT_EQ(variant.told, 1);
}

/// What an earlier frame left may be of use to one of as many spheres, where it was built as a whole.
TEST(HostSearch, ConstructsAgainOnlyWhatStands) {
  OnePair variant;
  Collisions found;
  const auto updates_again = [&](std::uint32_t size) {
    const int before = variant.constructed_again;
    variant.update(row(size), {});
    EXPECT_NO_THROW(variant.find(row(size), {}, found));
    return variant.constructed_again > before;
  };
  EXPECT_FALSE(updates_again(3)) << "there is nothing yet";
  EXPECT_TRUE(updates_again(3));
  EXPECT_FALSE(updates_again(4));
  EXPECT_TRUE(updates_again(4));
  variant.build(row(4));
  EXPECT_EQ(variant.constructed_again, 2) << "a build is no update";
  variant.constructing = [] { throw std::runtime_error("no memory"); };
  EXPECT_THROW(variant.update(row(4), {}), std::runtime_error);
  EXPECT_THROW(variant.find(row(4), {}, found), std::logic_error);
  variant.constructing = [] {};
  EXPECT_FALSE(updates_again(4)) << "of what a failure left";
}

TEST(HostSearch, AnswersWhatIsAskedAlsoWhereItShowsEvidence) {
  OnePair variant;
  variant.build(row(3));
  Collisions found;
  Tested shown;
  variant.find_with_evidence(row(3), {}, found, shown);
  EXPECT_EQ(found.pairs, (std::vector<Pair>{{0, 2}}));
  EXPECT_EQ(shown.pairs, found.pairs);
  variant.find_with_evidence(row(3), {.want = Request::Want::counts}, found, shown);
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_EQ(found.count, (std::vector<std::uint32_t>{1, 0, 1}));
  EXPECT_THROW(variant.find_with_evidence(row(3), {.pair_limit = 0}, found, shown), PairLimitExceeded);
}

TEST(HostSearch, TimesBothStages) {
  static constexpr int ms = 10;
  OnePair variant;
  const auto sleep = [] { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); };
  variant.constructing = sleep;
  variant.build(row(3));
  EXPECT_GE(variant.timings().build_ms, ms);
  EXPECT_LT(variant.timings().find_ms, ms);
  variant.searching = sleep;
  Collisions found;
  variant.find(row(3), {}, found);
  EXPECT_GE(variant.timings().find_ms, ms);
}

}  // namespace
}  // namespace catena
