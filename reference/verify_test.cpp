#include "catena/reference/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/verify_inputs.h"

namespace catena::reference {
namespace {

/// The right answer, spoilt on purpose.
class Spoilt final : public Variant {
 public:
  using Spoil = std::function<void(Collisions&)>;
  using Show = std::function<void(BoundsVisitor&)>;
  explicit Spoilt(
      Spoil spoil, Show show = [](BoundsVisitor&) {})
      : spoil_(std::move(spoil)), show_(std::move(show)) {}

  void build(const Chain&) override {}
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    Answer right = exact_answer(chain, request.pair_limit);
    result = {right.pair_count > 0, right.pair_count, right.count, right.pairs};
    spoil_(result);
    if (request.want != Request::Want::pairs) result.pairs.clear();
  }
  Timings timings() const override { return {}; }
  void visit_bounds(BoundsVisitor& visitor) const override { show_(visitor); }

 private:
  Spoil spoil_;
  Show show_;
};

const Chain& rod() {
  static const Chain chain = [] {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 10; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 1});
    return Chain(spheres);
  }();
  return chain;
}

Verdict verdict(Spoilt variant, bool rounded, std::uint64_t pair_limit = 1000) {
  const Verification v = verify(variant, rounded, rod(), exact_answer(rod(), pair_limit));
  EXPECT_EQ(v.reason.empty(), v.verdict == Verdict::exact) << v.reason;
  return v.verdict;
}

void nothing(Collisions&) {}
void lose_a_pair(Collisions& c) {
  const Pair lost = c.pairs.back();
  c.pairs.pop_back();
  --c.count[lost.i], --c.count[lost.j], --c.pair_count;
}
void repeat_a_pair(Collisions& c) { c.pairs.push_back(c.pairs.front()), ++c.pair_count; }
void report_neighbours(Collisions& c) {
  c.pairs.push_back({3, 4}), ++c.pair_count, ++c.count[3], ++c.count[4];
}
void miscount(Collisions& c) { ++c.count[0]; }

TEST(Verify, TheRightAnswerIsExact) {
  EXPECT_EQ(verdict(Spoilt(nothing), false), Verdict::exact);
  EXPECT_EQ(verdict(Spoilt(nothing), true), Verdict::exact);
}

TEST(Verify, ADifferenceIsWrongUnlessTheArithmeticIsRounded) {
  for (const auto spoil : {lose_a_pair, miscount}) {
    EXPECT_EQ(verdict(Spoilt(spoil), false), Verdict::wrong);
    EXPECT_EQ(verdict(Spoilt(spoil), true), Verdict::differs);
  }
}

TEST(Verify, RoundingExcusesNeitherRepeatedPairsNorNeighbours) {
  for (const auto spoil : {repeat_a_pair, report_neighbours}) {
    EXPECT_EQ(verdict(Spoilt(spoil), false), Verdict::wrong);
    EXPECT_EQ(verdict(Spoilt(spoil), true), Verdict::wrong);
  }
}

TEST(Verify, BoundsThatDoNotEncloseAndTreesThatAreNone) {
  const auto tree = [](double radius, std::uint32_t leaves) {
    return [=](BoundsVisitor& visitor) {
      for (std::uint32_t i = 0; i < leaves; ++i)
        visitor.edge(10, Sphere64{4.5, 0, 0, radius}, i, Sphere64{double(i), 0, 0, 1});
    };
  };
  EXPECT_EQ(verdict(Spoilt(nothing, tree(5.5, 10)), false), Verdict::exact);
  EXPECT_EQ(verdict(Spoilt(nothing, tree(5.4, 10)), false), Verdict::wrong);
  EXPECT_EQ(verdict(Spoilt(nothing, tree(5.4, 10)), true), Verdict::differs);
  EXPECT_EQ(verdict(Spoilt(nothing, tree(5.5, 9)), true), Verdict::wrong);  // a sphere is lost
}

/// Whether the tree shows its bounds as nested or not: what is shown must be of this chain, and one bound a
/// node.
TEST(Verify, RoundingExcusesNoLeafOfAnotherChainAndNoNodeOfTwoBounds) {
  const auto tree = [](double of_leaf, double of_root) {
    return [=](BoundsVisitor& visitor) {
      for (std::uint32_t i = 0; i < 10; ++i)
        visitor.edge(10, Sphere64{4.5, 0, 0, i == 7 ? of_root : 6.0}, i,
                     Sphere64{double(i), 0, 0, i == 7 ? of_leaf : 1.0});
    };
  };
  for (const bool rounded : {false, true}) {
    EXPECT_EQ(verdict(Spoilt(nothing, tree(1, 6)), rounded), Verdict::exact);
    EXPECT_EQ(verdict(Spoilt(nothing, tree(0.5, 6)), rounded), Verdict::wrong);
    EXPECT_EQ(verdict(Spoilt(nothing, tree(1, 7)), rounded), Verdict::wrong);
  }
}

/// What is wrong, and no more: of neighbours no margin, of pairs not that their counts differ too.
TEST(Verify, SaysWhatDiffers) {
  const auto reason = [](Spoilt variant, std::uint64_t limit = 1000) {
    return verify(variant, false, rod(), exact_answer(rod(), limit)).reason;
  };
  EXPECT_EQ(reason(Spoilt(lose_a_pair)), "largest margin 0.0e+00");
  EXPECT_EQ(reason(Spoilt([](Collisions& c) {
              c.pairs.push_back({0, 3}), ++c.pair_count, ++c.count[0], ++c.count[3];
            })),
            "largest margin 1.2e+00");
  EXPECT_EQ(reason(Spoilt(report_neighbours)), "1 neighbours reported");
  EXPECT_EQ(reason(Spoilt(repeat_a_pair)), "1 pairs repeated");
  EXPECT_EQ(reason(Spoilt([](Collisions& c) {
              c.pairs.push_back({3, 2}), ++c.pair_count;
            })),
            "1 pairs not i < j < n");
  EXPECT_EQ(reason(Spoilt([](Collisions& c) {
              c.pairs.push_back({3, 10}), ++c.pair_count;
            })),
            "1 pairs not i < j < n");
  EXPECT_EQ(reason(Spoilt(miscount)), "1 counts wrong; 1 counts unlike its pairs");
  EXPECT_EQ(reason(Spoilt([](Collisions& c) { ++c.pair_count; })), "wrong total");
  EXPECT_EQ(reason(Spoilt(miscount), 3), "1 counts wrong (compared by counts: a flood of pairs)");
  const auto tree = [](double radius, std::uint32_t leaves) {
    return [=](BoundsVisitor& visitor) {
      for (std::uint32_t i = 0; i < leaves; ++i)
        visitor.edge(10, Sphere64{4.5, 0, 0, radius}, i, Sphere64{double(i), 0, 0, 1});
    };
  };
  EXPECT_EQ(reason(Spoilt(nothing, tree(5, 10))), "20.0 % unenclosed, worst by 1.0e-01 of the parent");
  EXPECT_EQ(reason(Spoilt(nothing, tree(6, 8))), "not a tree: 1 roots, 2 spheres lost, 0 nodes shared");
}

TEST(Verify, PastTheLimitCountsAreCompared) {
  EXPECT_EQ(verdict(Spoilt(nothing), false, 3), Verdict::exact);
  EXPECT_EQ(verdict(Spoilt(miscount), false, 3), Verdict::wrong);
  EXPECT_EQ(verdict(Spoilt([](Collisions& c) { ++c.pair_count; }), false, 3), Verdict::wrong);
  EXPECT_EQ(verdict(Spoilt([](Collisions& c) { c.found = false; }), false, 3), Verdict::wrong);
  Spoilt variant(nothing);
  EXPECT_FALSE(verify(variant, false, rod(), exact_answer(rod(), 3)).by_pairs);
}

TEST(Verify, AFloodOfInventedPairsIsComparedByCounts) {
  Spoilt variant([pairs_asked = true](Collisions& c) mutable {
    if (std::exchange(pairs_asked, false)) throw PairLimitExceeded(1000, 100);
    miscount(c);
  });
  const Verification v = verify(variant, true, rod(), exact_answer(rod(), 1000));
  EXPECT_FALSE(v.by_pairs);
  EXPECT_EQ(v.comparison.wrong_counts, 1u);
  EXPECT_EQ(v.verdict, Verdict::differs);
}

TEST(Verify, ADeclaredLimitIsARefusal) {
  EXPECT_EQ(verdict(Spoilt([](Collisions&) { throw CapacityError("at most 4 spheres"); }), false),
            Verdict::refused);
}

// That the machine lacks something says nothing of the variant.
TEST(Verify, WantOfMemoryOrThreadsDecidesNothing) {
  const auto starved = [](const auto& thrown) {
    return verdict(Spoilt([=](Collisions&) { throw thrown; }), false);
  };
  EXPECT_EQ(starved(std::bad_alloc()), Verdict::undecided);
  EXPECT_EQ(starved(std::runtime_error("pthread_create has failed: Resource temporarily unavailable")),
            Verdict::undecided);
  EXPECT_EQ(starved(std::runtime_error("a fault")), Verdict::wrong);
  Spoilt late(nothing, [](BoundsVisitor&) { throw std::bad_alloc(); });
  const Verification v = verify(late, false, rod(), exact_answer(rod(), 1000));
  EXPECT_EQ(v.verdict, Verdict::undecided);
  EXPECT_EQ(v.reason, "out of memory");
  EXPECT_FALSE(v.ran);
  EXPECT_STREQ(Undecided(1).what(),
               "1 answer not decided: the machine had too little memory or threads; take fewer spheres");
}

/// Compares all pairs and says so, but for the pairs that it keeps to itself.
class Witness final : public Variant {
 public:
  using Spoil = std::function<void(Collisions&)>;
  explicit Witness(std::uint64_t kept_back, Spoil spoil_find = {}, Spoil spoil_evident = {})
      : kept_back_(kept_back), spoil_find_(std::move(spoil_find)), spoil_evident_(std::move(spoil_evident)) {}
  void build(const Chain& chain) override { variant_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    variant_->find(chain, request, result);
    if (spoil_find_) spoil_find_(result);
  }
  Timings timings() const override { return {}; }
  Accounting evidence() const override { return Accounting::each_pair; }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    variant_->find(chain, request, result);
    if (spoil_evident_) spoil_evident_(result);
    std::uint64_t told = 0;
    for (std::uint32_t i = 0; i < chain.size(); ++i)
      for (std::uint32_t j = i + 1; j < chain.size(); ++j)
        if (told++ >= kept_back_) chain.neighbours(i, j) ? sink.excluded(i, j) : sink.tested(i, j);
  }

 private:
  std::unique_ptr<Variant> variant_ = StrategyRegistry::instance().make("CPU1");
  std::uint64_t kept_back_;
  Spoil spoil_find_, spoil_evident_;
};

TEST(Verify, ACertificateProvesTheAnswerOnlyWhenItAccountsForEveryPair) {
  std::uint64_t pairs = 0;
  Witness honest(0), silent(1);
  const Verification proved = verify_by_certificate(honest, rod(), 1000, pairs);
  EXPECT_EQ(proved.verdict, Verdict::exact) << proved.reason;
  EXPECT_EQ(pairs, exact_answer(rod(), 1000).pair_count);
  EXPECT_GT(pairs, 0u);
  const Verification unproved = verify_by_certificate(silent, rod(), 1000, pairs);
  EXPECT_EQ(unproved.verdict, Verdict::wrong);
  EXPECT_EQ(unproved.reason, "not certified: some pairs are accounted for never or more than once");
  EXPECT_EQ(pairs, 0u);
}

// The evidence is of another run than find(), which may have threads and lanes of its own to lose a pair in.
TEST(Verify, ACertificateIsOfWhatFindAnswers) {
  std::uint64_t pairs = 0;
  for (const auto spoil : {lose_a_pair, repeat_a_pair, miscount}) {
    Witness lost_in_find(0, spoil), lost_in_evidence(0, {}, spoil);
    EXPECT_EQ(verify_by_certificate(lost_in_find, rod(), 1000, pairs).verdict, Verdict::wrong);
    EXPECT_EQ(pairs, exact_answer(rod(), 1000).pair_count) << "what is proved, whatever was found";
    const Verification v = verify_by_certificate(lost_in_evidence, rod(), 1000, pairs);
    EXPECT_EQ(v.verdict, Verdict::wrong);
    EXPECT_EQ(v.reason, "the search with evidence gives another answer than its evidence proves");
  }
}

TEST(Verify, ACertificateOfCountsAloneIsEnoughPastThePairLimit) {
  std::uint64_t pairs = 0;
  Witness honest(0);
  const Verification proved = verify_by_certificate(honest, rod(), 3, pairs);
  EXPECT_EQ(proved.verdict, Verdict::exact) << proved.reason;
  EXPECT_FALSE(proved.by_pairs);
  EXPECT_GT(pairs, 3u);
}

TEST(VerifyInputs, AreEverySceneAndTheSampleFilesAndAllOpen) {
  const auto inputs = default_inputs();
  const auto& scenes = SceneRegistry::instance().scenes();
  EXPECT_GT(inputs.size(), scenes.size() + 3);
  for (const auto& scene : scenes)
    EXPECT_EQ(std::ranges::count(inputs, scene.name + ":n=1500"), 1) << scene.name;
  for (const auto& input : inputs)
    EXPECT_GT(open_for_verification(input, {.takes_box = true}, true).animation->frame(0).size(), 0u)
        << input;
  const auto files =
      std::ranges::find_if(inputs, [](const std::string& input) { return input.starts_with('/'); });
  EXPECT_GT(inputs.end() - files, 5);
  EXPECT_TRUE(std::is_sorted(files, inputs.end())) << "the same on every machine";
}

/// A file without radii gets half its spacing, unless a radius is asked for, or it is no sample.
TEST(VerifyInputs, OfASampleWithoutRadiiHaveHalfItsSpacing) {
  const std::string file = CATENA_SOURCE_DIR "/core/readers/examples/9_47-cubiclattice.txt";
  const auto radius = [&](InputOptions options, bool sample) {
    return open_for_verification(file, options, sample).animation->frame(0)[0].radius;
  };
  EXPECT_EQ(radius({}, true), 0.5f);
  EXPECT_EQ(radius({.radius = 0.25f}, true), 0.25f);
  EXPECT_EQ(radius({.radius = 0.25f}, false), 0.25f);
  EXPECT_THROW(radius({}, false), InputError);
}

}  // namespace
}  // namespace catena::reference
