#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/command_line.h"
#include "catena/core/strategy/test_variant.h"

/// The exit code of `catena verify`, of a variant that a test makes wrong.
namespace catena::reference {
namespace {

/// Its search loses a pair; what it proves is right.
class LosesAPair final : public Variant {
 public:
  void build(const Chain& chain) override { tree_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    tree_->find(chain, request, found);
    if (!found.pairs.empty()) found.pairs.pop_back(), --found.pair_count;
  }
  void visit_bounds(BoundsVisitor& visitor) const override { tree_->visit_bounds(visitor); }
  Accounting evidence() const override { return tree_->evidence(); }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& found,
                          EvidenceSink& sink) override {
    tree_->find_with_evidence(chain, request, found, sink);
  }
  Timings timings() const override { return {}; }

 private:
  const std::unique_ptr<Variant> tree_ = StrategyRegistry::instance().make("aCPU2+CPU2");
};

const test::RegisterHidden<LosesAPair> loses_a_pair{{.name = "LosesAPair", .summary = "as a test asks"}};

TEST(VerifyCommand, EndsWithOneForAWrongAnswerByEitherJudge) {
  const auto commands = CommandRegistry::instance().commands();
  const auto run = [&](std::vector<std::string> arguments, const std::string& variant) {
    const auto command = std::ranges::find(commands, "verify", &CommandInfo::name)->make();
    arguments.insert(arguments.begin(), {"winding:n=300", "--variant", variant});
    parse_options(arguments, [&](OptionParser& app) { command->configure(app); });
    ::testing::internal::CaptureStdout();
    const int code = command->run();
    return ::testing::internal::GetCapturedStdout().empty() ? -1 : code;
  };
  for (const std::vector<std::string>& judge : {std::vector<std::string>{}, {"--certify"}}) {
    EXPECT_EQ(run(judge, "aCPU2+CPU2"), 0) << judge.size();
    EXPECT_EQ(run(judge, "LosesAPair"), 1) << judge.size();
  }
}

}  // namespace
}  // namespace catena::reference
