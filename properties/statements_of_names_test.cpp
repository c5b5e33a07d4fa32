// As statements_test.cpp, of variants that a statement makes by their names.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "catena/core/executor/team.h"
#include "catena/core/strategy/test_variant.h"
#include "catena/properties/testing/faulty.h"

namespace catena::properties {
namespace {

/// All pairs, and with several threads whatever a test asks for.
class Uneven final : public Variant {
 public:
  static inline std::function<void(Collisions&)> spoil = {};

  explicit Uneven(const Parameters& parameters)
      : several_(parameters.unsigned_integer("threads", 1, 64) > 1) {}
  void build(const Chain& chain) override { all_pairs_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    all_pairs_->find(chain, request, found);
    if (several_ && spoil) spoil(found);
  }
  Timings timings() const override { return {}; }

 private:
  const std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
  const bool several_;
};

const test::RegisterHidden<Uneven> uneven{
    {.name = "Uneven", .summary = "as a test asks", .parameters = {Team::threads_parameter()}}};

TEST(Statements, NoticeThreadsThatDisagree) {
  const Subject subject = Subject::named("Uneven");
  for (const auto& property : PropertyRegistry::instance().make_all()) {
    if (property->name() != "any number of threads") continue;
    const auto said = [&](const std::function<void(Collisions&)>& spoil) {
      Uneven::spoil = spoil;
      const auto fault = property->check(subject, *subject.make(), row());
      Uneven::spoil = {};
      return fault.value_or("nothing");
    };
    EXPECT_EQ(said({}), "nothing");
    EXPECT_NE(said(drop_a_pair).find("threads give"), std::string::npos);
    EXPECT_NE(said([](Collisions& found) { ++found.count[0]; }).find("other counts"), std::string::npos);
  }
}

}  // namespace
}  // namespace catena::properties
