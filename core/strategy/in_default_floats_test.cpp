#include "catena/core/strategy/in_default_floats.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <memory>
#include <string>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/float_environment.h"

namespace catena {
namespace {

/// Notes what it is asked, and answers all of it with what no other variant does.
class Asked : public Variant {
 public:
  explicit Asked(std::vector<std::string>& asked) : asked_(asked) {}
  void prepare(const Request& request) override { note("prepare", request.pair_limit); }
  void build(const Chain& chain) override { note("build", chain.size()); }
  void update(const Chain& chain, const Moved& moved) override {
    note("update", chain.size() + 10 * static_cast<std::uint64_t>(moved.shift()));
  }
  void find(const Chain&, const Request& request, Collisions& found) override {
    note("find", request.pair_limit);
    found.pair_count = 7;
  }
  void find_with_evidence(const Chain&, const Request& request, Collisions& found, EvidenceSink&) override {
    note("find_with_evidence", request.pair_limit);
    found.pair_count = 8;
  }
  Timings timings() const override { return {1, 2, 3, 4}; }
  Plan plan() const override { return {{"step", true, "reason"}}; }
  std::vector<WorkDone> work() const override { return {{"tests", 9}}; }
  std::string answered_by() const override { return "another"; }
  void visit_bounds(BoundsVisitor&) const override { note("visit_bounds", 0); }
  Accounting evidence() const override { return Accounting::each_pair; }

 protected:
  void note(const std::string& what, std::uint64_t number) const {
    asked_.push_back(what + " " + std::to_string(number) +
                     (DefaultFloats::stands() ? "" : " in strange floats"));
  }

 private:
  std::vector<std::string>& asked_;
};

class AskedAndKeeping final : public Asked, public KeepsAnswer, public EvidenceNodes, ResidentSearch {
 public:
  using Asked::Asked;
  ResidentSearch* resident() override { return this; }
  void enqueue_build(const ChainView& chain, const Request&, StreamHandle) override {
    note("enqueue_build", chain.size);
  }
  void enqueue_find(const ChainView& chain, const Request&, const ResidentAnswer&, StreamHandle) override {
    note("enqueue_find", chain.size);
  }
  void mend(const ResidentState& seen) override { note("mend", seen.found); }
  const Collisions& find_kept(const Chain&, const Request& request) override {
    note("find_kept", request.pair_limit);
    return kept_;
  }
  void visit_evidence(const Chain& chain, BoundsVisitor&) const override { note("visit_evidence", chain.size()); }
  const Collisions kept_{true, 11, {}, {}};
};

struct Ignored final : BoundsVisitor, EvidenceSink {
  void edge(std::uint32_t, const AnyBound&, std::uint32_t, const AnyBound&) override {}
  void discarded(std::uint32_t, std::uint32_t) override {}
  void tested(std::uint32_t, std::uint32_t) override {}
  void excluded(std::uint32_t, std::uint32_t) override {}
};

/// What it is asked it asks, and what it is told it tells; of one that keeps no answer it keeps it itself.
TEST(InDefaultFloats, PassesAllOnAsItIs) {
  const Chain chain(std::vector<Sphere>(3, Sphere{0, 0, 0, 1}));
  const Request request{.pair_limit = 5};
  for (const bool keeping : {false, true}) {
    std::vector<std::string> asked;
    std::unique_ptr<Variant> inner;
    if (keeping)
      inner = std::make_unique<AskedAndKeeping>(asked);
    else
      inner = std::make_unique<Asked>(asked);
    InDefaultFloats variant(std::move(inner));
    Collisions found;
    Ignored ignored;
    {
      const properties::StrangeFloats strange(FE_UPWARD);
      variant.prepare(request);
      variant.build(chain);
      variant.update(chain, Moved::along(2));
      variant.find(chain, request, found);
      EXPECT_EQ(found.pair_count, 7u);
      variant.find_with_evidence(chain, request, found, ignored);
      EXPECT_EQ(found.pair_count, 8u);
      variant.visit_bounds(ignored);
      variant.visit_evidence(chain, ignored);
      EXPECT_EQ(variant.find_kept(chain, request).pair_count, keeping ? 11u : 7u);
    }
    EXPECT_EQ(asked,
              (std::vector<std::string>{"prepare 5", "build 3", "update 23", "find 5", "find_with_evidence 5",
                                        "visit_bounds 0", keeping ? "visit_evidence 3" : "visit_bounds 0",
                                        keeping ? "find_kept 5" : "find 5"}));
    const Timings told = variant.timings();
    EXPECT_EQ((std::vector{told.build_ms, told.find_ms, told.transfer_ms, told.start_ms}),
              (std::vector<double>{1, 2, 3, 4}));
    ASSERT_EQ(variant.plan().size(), 1u);
    EXPECT_EQ(variant.plan()[0].reason, "reason");
    ASSERT_EQ(variant.work().size(), 1u);
    EXPECT_EQ(variant.work()[0].times, 9u);
    EXPECT_EQ(variant.answered_by(), "another");
    EXPECT_EQ(variant.evidence(), Accounting::each_pair);
    EXPECT_EQ(variant.resident() != nullptr, keeping);
  }
}

/// A resident search computes its cells on the host.
TEST(InDefaultFloats, PassesOnWhatIsResident) {
  std::vector<std::string> asked;
  InDefaultFloats variant(std::make_unique<AskedAndKeeping>(asked));
  ChainView chain{};
  chain.size = 3;
  {
    const properties::StrangeFloats strange(FE_UPWARD);
    variant.resident()->enqueue_build(chain, {}, nullptr);
    variant.resident()->enqueue_find(chain, {}, {}, nullptr);
    variant.resident()->mend({4, 1});
  }
  EXPECT_EQ(asked, (std::vector<std::string>{"enqueue_build 3", "enqueue_find 3", "mend 4"}));
}

/// Of both stages, the construction's first.
TEST(Composed, TellsWhatItsTraversalDecided) {
  const auto variant = StrategyRegistry::instance().make("aCPU2+GPU2@host(threads=1)");
  const Chain chain(std::vector<Sphere>(3, Sphere{0, 0, 0, 1}));
  Collisions found;
  variant->build(chain);
  variant->find(chain, {}, found);
  std::vector<std::string> steps;
  for (const Decision& decision : variant->plan()) steps.push_back(decision.step);
  ASSERT_GE(steps.size(), 2u);
  EXPECT_EQ((std::vector<std::string>{steps.end() - 2, steps.end()}),
            (std::vector<std::string>{"range checks", "more threads"}));
}

/// What it is made of may be computed, too.
TEST(InDefaultFloats, IsMadeThere) {
  bool stood = false;
  StrategyRegistry some;
  some.add_variant({.name = "A", .summary = "one"}, {"robust"}, [&](const Parameters&) {
    stood = DefaultFloats::stands();
    return StrategyRegistry::instance().make("CPU1");
  });
  {
    const properties::StrangeFloats strange(FE_UPWARD);
    some.make("A");
  }
  EXPECT_TRUE(stood);
}

}  // namespace
}  // namespace catena
