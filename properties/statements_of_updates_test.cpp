// As statements_test.cpp, of what is said of a chain that moves, and of a proof.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/strategy/keeps_answer.h"
#include "catena/properties/allocations.h"
#include "catena/properties/testing/faulty.h"

namespace catena::properties {
namespace {

TEST(Statements, NoticeUpdatesThatAreNoBuilds) {
  const auto after_update = [](auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (q.told.updates > 0 && q.request.want == Want::pairs) spoil(q.told, found);
    }};
  };
  expect_noticed("update is build", after_update([](const Told&, Collisions& found) { drop_a_pair(found); }),
                 "not exact");
  expect_noticed("update is build", after_update([](const Told& told, Collisions& found) {
                   if (!told.told_all) drop_a_pair(found);
                 }),
                 "told what moved");
  expect_noticed("update is build", after_update([](const Told& told, Collisions& found) {
                   if (told.told_none) drop_a_pair(found);
                 }),
                 "told what moved");
  expect_noticed("update is build", after_update([](const Told& told, Collisions& found) {
                   if (told.updates % 2 == 0) drop_a_pair(found);
                 }),
                 "on the way back");
  const auto drops = after_update([](const Told&, Collisions& found) { drop_a_pair(found); });
  expect_noticed("update is build", drops, "pairs after update", row(), rounded());
  const auto counts = after_update([](const Told&, Collisions& found) { ++found.count[0]; });
  expect_noticed("update is build", counts, "pairs after update", row(), rounded());

  const auto shown = [](auto show) {
    return Faulty::Fault{.bounds = [=](const Told& told, BoundsVisitor& visitor) {
      show(*told.chain, visitor, told.updates > 0);
    }};
  };
  expect_noticed("update is build", shown([](const Chain& c, BoundsVisitor& v, bool updated) {
                   show_twos(c, v, 1e9, updated ? 2 : 0);
                 }),
                 "another shape");
  expect_noticed("update is build", shown([](const Chain& c, BoundsVisitor& v, bool updated) {
                   show_twos(c, v, updated ? 1e-9 : 1e9);
                 }),
                 "do not enclose after update");
  VariantInfo same_bits;
  same_bits.promises.same_bits = true;
  expect_noticed("update is build", shown([](const Chain& c, BoundsVisitor& v, bool updated) {
                   show_twos(c, v, updated ? 2e9 : 1e9);
                 }),
                 "a bound after update", row(), same_bits);
}

TEST(Statements, NoticeAllocations) {
  if (Allocations::counter() == nullptr) GTEST_SKIP() << "nobody counts";
  const auto allocate = [] { ::operator delete(::operator new(8)); };
  /// Answers from memory that it has.
  const auto quiet = [=](auto when) {
    return Faulty::Fault{.instead =
                             [=](const Question& q, Collisions& found) {
                               found = {false, 0, std::move(found.count), std::move(found.pairs)};
                               found.pairs.clear();
                               found.count.assign(q.request.want == Want::any ? 0 : q.chain.size(), 0);
                               if (when(q.request.want)) allocate();
                               return true;
                             },
                         .begin = {}};
  };
  const auto never = [](Want) { return false; };
  EXPECT_EQ(asked("no allocation once warm", quiet(never), row()), std::nullopt);
  auto in_update = quiet(never);
  in_update.begin = [=](const Told& told) {
    if (told.updates > 1) allocate();
  };
  const auto update = asked("no allocation once warm", in_update, row());
  ASSERT_TRUE(update);
  EXPECT_NE(update->find("in two updates"), std::string::npos) << *update;
  for (const auto& [want, name] :
       {std::pair{Want::pairs, "pairs"}, {Want::counts, "counts"}, {Want::any, "any"}}) {
    const auto find =
        asked("no allocation once warm", quiet([=](Want asked) { return asked == want; }), row());
    ASSERT_TRUE(find) << name;
    EXPECT_NE(find->find(std::string("in a find of ") + name), std::string::npos) << *find;
  }
}

TEST(Statements, NoticeFramesThatAreAnsweredWrongly) {
  const Case test = row();
  const auto spoilt = [](auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (q.told.updates > 0) spoil(q, found);
    }};
  };
  expect_noticed("frame after frame", spoilt([](const Question&, Collisions& found) {
                   if (!found.pairs.empty()) drop_a_pair(found);
                 }),
                 "pairs, exactly");
  expect_noticed("frame after frame", spoilt([](const Question& q, Collisions& found) {
                   if (q.request.want == Want::counts) ++found.count[0];
                 }),
                 "other counts alone");
  expect_noticed("frame after frame", spoilt([](const Question& q, Collisions& found) {
                   if (q.request.want == Want::any) found.found = !found.found;
                 }),
                 "yes or no");
  // What a caller tells is told, ranges and shifts.
  expect_noticed("frame after frame", spoilt([](const Question& q, Collisions& found) {
                   if (!q.told.told_all) drop_a_pair(found);
                 }),
                 ", parts: ");
  // What a film of a short chain is made of.
  const auto miscounted = [&](auto when) {
    return spoilt([=](const Question& q, Collisions& found) {
      if (q.request.want == Want::pairs && when(q.chain)) ++found.count[0];
    });
  };
  const float radius = test.chain[0].radius;
  expect_noticed("frame after frame",
                 miscounted([](const Chain& c) { return c[c.size() / 2] == c[c.size() / 8]; }),
                 ", shift but for a sphere: ");
  expect_noticed("frame after frame", miscounted([](const Chain& c) { return c[0].x != std::floor(c[0].x); }),
                 ", drift: ");
  expect_noticed("frame after frame", miscounted([=](const Chain& c) { return c[0].radius > radius; }),
                 ", growth: ");
  expect_noticed("frame after frame", miscounted([=](const Chain& c) { return c[0].radius < radius; }),
                 ", shrinking: ");
  // Frames that are not searched are updated all the same.
  expect_noticed("frame after frame", spoilt([](const Question& q, Collisions& found) {
                   if (q.told.unsearched > 1) drop_a_pair(found);
                 }),
                 "pairs, exactly");
}

/// Loses a pair of an answer that it keeps.
class LosesKept final : public Variant, public KeepsAnswer {
 public:
  void build(const Chain& chain) override { all_pairs_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    all_pairs_->find(chain, request, found);
  }
  const Collisions& find_kept(const Chain& chain, const Request& request) override {
    find(chain, request, kept_);
    drop_a_pair(kept_);
    return kept_;
  }
  Timings timings() const override { return {}; }

 private:
  const std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
  Collisions kept_;
};

TEST(Statements, NoticeAKeptAnswerThatIsWrong) {
  LosesKept variant;
  for (const auto& property : PropertyRegistry::instance().make_all()) {
    if (property->name() != "frame after frame") continue;
    const auto fault = property->check(Subject::named("CPU1"), variant, row());
    ASSERT_TRUE(fault);
    EXPECT_NE(fault->find("another answer where it is kept"), std::string::npos) << *fault;
  }
}

TEST(Statements, NoticeAProofOfAnotherNumberOfPairs) {
  const Case right = row();
  reference::Answer more = right.exact;
  ++more.pair_count;
  const Case wrong(right.chain, more);
  const auto variant = StrategyRegistry::instance().make("aCPU2+CPU2");
  for (const auto& property : PropertyRegistry::instance().make_all()) {
    if (property->name() != "evidence") continue;
    EXPECT_EQ(property->check(Subject::named("aCPU2+CPU2"), *variant, right), std::nullopt);
    const auto fault = property->check(Subject::named("aCPU2+CPU2"), *variant, wrong);
    ASSERT_TRUE(fault);
    EXPECT_NE(fault->find("pairs proved"), std::string::npos) << *fault;
  }
}

/// Its search with evidence loses a pair after an update.
class LosesProof final : public Variant {
 public:
  void build(const Chain& chain) override { updated_ = false, tree_->build(chain); }
  void update(const Chain& chain, const Moved& moved) override {
    updated_ = true, tree_->update(chain, moved);
  }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    tree_->find(chain, request, found);
  }
  void visit_bounds(BoundsVisitor& visitor) const override { tree_->visit_bounds(visitor); }
  Accounting evidence() const override { return tree_->evidence(); }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& found,
                          EvidenceSink& sink) override {
    tree_->find_with_evidence(chain, request, found, sink);
    if (updated_) drop_a_pair(found);
  }
  Timings timings() const override { return {}; }

 private:
  const std::unique_ptr<Variant> tree_ = StrategyRegistry::instance().make("aCPU2+CPU2");
  bool updated_ = false;
};

TEST(Statements, NoticeAProofThatIsWrongAfterAnUpdate) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < 25; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 1.25f});
  const Case test = Case::of(Chain(std::move(spheres)));
  LosesProof variant;
  for (const auto& property : PropertyRegistry::instance().make_all()) {
    if (property->name() != "evidence") continue;
    const auto fault = property->check(Subject::named("aCPU2+CPU2"), variant, test);
    ASSERT_TRUE(fault);
    EXPECT_TRUE(fault->starts_with("after an update: ")) << *fault;
  }
}

}  // namespace
}  // namespace catena::properties
