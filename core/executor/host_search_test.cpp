#include "catena/core/executor/host_search.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

namespace catena {
namespace {

Chain row(std::uint32_t size) { return Chain(std::vector<Sphere>(size, Sphere{0, 0, 0, 1})); }

/// Reports one pair, does what it is told while it builds and searches.
class OnePair final : public HostSearch {
 public:
  std::function<void()> constructing = [] {}, searching = [] {};

 private:
  void construct(const ChainView&) override { constructing(); }
  void search(const ChainView&, PairCollector& collector) override {
    searching();
    collector.lane(0).collide(0, 2);
  }
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
