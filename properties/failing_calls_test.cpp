#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "catena/core/error.h"
#include "catena/core/thrown.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/suite.h"
#include "catena/properties/testing/letters_of.h"

// Calls that fail, of variants and of what holds state beside them.
namespace catena::properties {
namespace {

std::unique_ptr<Property> failing_calls() {
  for (auto& property : PropertyRegistry::instance().make_all())
    if (property->name() == "calls in any order, some of which fail") return std::move(property);
  return nullptr;
}

class FailingCalls : public testing::TestWithParam<const char*> {};

TEST_P(FailingCalls, LeaveNoWrongAnswerBehind) {
  const auto property = failing_calls();
  ASSERT_NE(property, nullptr);
  const Subject subject = Subject::named(GetParam());
  const auto variant = subject.make();
  const char* rounds = std::getenv("ROUNDS");
  const char* size = std::getenv("SIZE");
  std::uint64_t seed = 0;
  for (int round = 0; round < (rounds ? atoi(rounds) : 1); ++round)
  for (const Family& family : FamilyRegistry::instance().families()) {
    Dice dice(++seed);
    const Case test = Case::of(generate(family, dice, size ? atoi(size) : 48));
    std::optional<std::string> fault;
    try { fault = property->check(subject, *variant, test); } catch (...) { fault = "threw: " + thrown_words(); }
    EXPECT_FALSE(fault) << family.name << ", " << seed << ": " << *fault;
    if (fault && !std::getenv("ON")) break;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, FailingCalls,
                         testing::Values("auto", "auto(frames=always)", "Hybrid(threads=2)", "Hybrid(threads=2,crowd=0,dense=1e6)","Hybrid(crowd=2)", "Grid(threads=2)", "Grid", "SphereTree(threads=2)", "SphereTree",
                                         "GPU1@host(threads=2)", "aGPU2@host(threads=2,subtree=4,block=4)+GPU2@host(threads=2)", "bGPU2@host(block=8)+CPU2", "aCPU2+Dual", "ChainTree", "LBVH+Half", "MedianSplit+Half", "Necklace", "SweepAndPrune", "DeviceGrid@host", "DeviceHybrid@host(crowd=2)",
                                         "Parts", "Parts(parts=5,searches=1,group=1)","Parts(parts=5,searches=1,group=1,order=chain)", "Parts(parts=3,searches=4,group=1,order=chain)", "Parts(parts=3,searches=2,group=2,order=space)", "Parts(room=40,group=1)", "Ranks", "Ranks(ranks=2)", "FCL", "nanoflann", "Embree", "EmbreeRebuild"),
                         [](const auto& of) { return letters_of(of.param); });

}  // namespace
}  // namespace catena::properties
