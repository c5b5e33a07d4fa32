#include "catena/reports/few_pairs.h"

#include <gtest/gtest.h>

#include <set>

namespace catena::reports {
namespace {

std::set<std::string> names(const std::vector<bench::WorkloadSpec>& specs) {
  std::set<std::string> names;
  for (const auto& spec : specs) names.insert(spec.input);
  return names;
}

/// As a report of these inputs, which asks for each wherever it can.
Profile of_inputs(const std::vector<std::string>& inputs) {
  Profile profile;
  for (const auto& input : inputs) profile.inputs.push_back({input});
  profile.shown = profile.wants_inputs = profile.coherent_inputs = profile.regret_inputs = profile.inputs;
  profile.planned_inputs = inputs;
  profile.animation_input = profile.inputs.back();
  return profile;
}

TEST(FewPairs, AreLeftOfTheInputsInEverySection) {
  const auto make = [](const bench::WorkloadSpec& spec) {
    if (spec.input == "heap") throw bench::TooManyPairs("heap/n:9", PairLimitExceeded(70, 60));
  };
  testing::internal::CaptureStderr();
  const Profile left = with_few_pairs(of_inputs({"loop", "heap", "walk", "heap"}), make);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "catena report: heap/n:9: 70 pairs collide; with more than 60 no answer is compared; it is left "
            "out\n");
  const std::set<std::string> expected{"loop", "walk"};
  for (const auto* specs :
       {&left.inputs, &left.shown, &left.wants_inputs, &left.coherent_inputs, &left.regret_inputs})
    EXPECT_EQ(names(*specs), expected);
  EXPECT_EQ(left.planned_inputs, (std::vector<std::string>{"loop", "walk"}));
  EXPECT_EQ(left.animation_input.input, "");
}

TEST(FewPairs, IsAllThatIsAskedOfAnInput) {
  const auto refuse = [](const bench::WorkloadSpec&) { throw InputError("no such file"); };
  EXPECT_THROW(with_few_pairs(of_inputs({"loop"}), refuse), InputError);
  const Profile same = with_few_pairs(of_inputs({"loop", "heap"}), [](const bench::WorkloadSpec&) {});
  EXPECT_EQ(names(same.inputs), (std::set<std::string>{"loop", "heap"}));
  EXPECT_EQ(same.animation_input.input, "heap");
}

}  // namespace
}  // namespace catena::reports
