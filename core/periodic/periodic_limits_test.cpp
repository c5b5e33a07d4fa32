// What a search in a box refuses, where it ends, and what it leaves behind.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "catena/core/error.h"
#include "catena/core/periodic/test_search.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/strategy/step_names.h"

namespace catena {
namespace {

TEST(Periodic, RefusesASphereMoreBoxesAwayThanAreCounted) {
  const double most = 0x1p20;
  const auto at = [](double x) {
    return Chain({{0, 0, 0, 1}, {5, 5, 5, 0}, {static_cast<float>(x), 0, 0, 1}});
  };
  EXPECT_EQ(found("CPU1", at(10 * most), {{10, 10, 10}}).pairs, (Pairs{{0, 2}}));
  EXPECT_EQ(found("CPU1", at(-10 * most), {{10, 10, 10}}).pairs, (Pairs{{0, 2}}));
  for (const double x : {10 * (most + 2), -10 * (most + 2), 1e30})
    for (const auto want : {Request::Want::pairs, Request::Want::any})
      EXPECT_THROW(found("CPU1", at(x), {{10, 10, 10}}, {.want = want}), InputError) << x;
  // Whatever else collides, and so would be all that is asked for.
  const Chain collides(
      {{0, 0, 0, 1}, {5, 5, 5, 0}, {1, 0, 0, 1}, {static_cast<float>(10 * (most + 2)), 0, 0, 0}});
  EXPECT_THROW(found("CPU1", collides, {{10, 10, 10}}, {.want = Request::Want::any}), InputError);
}

TEST(Periodic, CountsAPairOnceThatTouchesThroughBothFaces) {
  const Chain chain(
      {{0, 0, 0, 1}, {9, 9, 9, 0}, {2, 0, 0, 1}});  // a box of twice the reach: touched from both sides
  const Collisions result = found("CPU1", chain, {{4, 20, 20}});
  EXPECT_EQ(result.pairs, (Pairs{{0, 2}}));
  EXPECT_EQ(result.count, (std::vector<std::uint32_t>{1, 0, 1}));
}

TEST(Periodic, StatesTheTrueNumberPastALimit) {
  std::vector<Sphere> spheres(40, Sphere{0, 0, 0, 1});
  for (std::size_t i = 0; i < 20; ++i) spheres[i].x = 9.5f;
  Request request;
  request.pair_limit = found("CPU1", Chain(spheres), {{10, 10, 10}}).pair_count;
  EXPECT_EQ(found("CPU1", Chain(spheres), {{10, 10, 10}}, request).pairs.size(), request.pair_limit)
      << "as many as may be";
  --request.pair_limit;
  EXPECT_THROW(found("CPU1", Chain(spheres), {{10, 10, 10}}, request), PairLimitExceeded);
  request.pair_limit = 5;
  try {
    found("CPU1", Chain(spheres), {{10, 10, 10}}, request);
    FAIL();
  } catch (const PairLimitExceeded& error) {
    EXPECT_EQ(error.found(), 40u * 39 / 2 - 39);
  }
  Periodic periodic(StrategyRegistry::instance().make("CPU1"), {{10, 10, 10}});
  Collisions result;
  periodic.build(Chain(spheres));
  EXPECT_THROW(periodic.find(Chain(spheres), request, result), PairLimitExceeded);
  EXPECT_TRUE(result.pairs.empty()) << "no part of them for all";
  EXPECT_LE(result.pairs.capacity(), 2 * request.pair_limit) << "no memory for what is not kept";
  request.want = Request::Want::counts;
  EXPECT_EQ(found("CPU1", Chain(spheres), {{10, 10, 10}}, request).pair_count, 40u * 39 / 2 - 39)
      << "a limit on pairs, not on counts";
}

/// Gives as many candidates as there are spheres at most, so that all others are searched for in parts.
class FewAtATime final : public Variant {
 public:
  void build(const Chain& chain) override { all_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    Request few = request;
    few.pair_limit = chain.size();
    ++finds;
    most_asked = std::max(most_asked, request.pair_limit);
    all_->find(chain, few, result);
  }
  int finds = 0;
  std::uint64_t most_asked = 0;
  Timings timings() const override { return {}; }

 private:
  const std::unique_ptr<Variant> all_ = StrategyRegistry::instance().make("CPU1");
};

TEST(Periodic, SearchesAFloodInParts) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < 83; ++i)
    spheres.push_back({i % 3 ? 9.5f : 0, 0.01f * static_cast<float>(i), 0, 1});
  const Chain chain(std::move(spheres));
  auto few = std::make_unique<FewAtATime>();
  const int& finds = few->finds;
  const std::uint64_t& most_asked = few->most_asked;
  Periodic in_parts(std::move(few), {{10, 10, 10}});
  Collisions result;
  in_parts.build(chain);
  EXPECT_GT(in_parts.timings().build_ms, 0) << "of its own, whatever the variant tells";
  in_parts.find(chain, {}, result);
  std::ranges::sort(result.pairs);
  EXPECT_LE(most_asked, 1u << 24) << "candidates have some memory, and no more";
  const Collisions whole = found("CPU1", chain, {{10, 10, 10}});
  EXPECT_GT(whole.pair_count, 2 * chain.size());
  EXPECT_EQ(result.pairs, whole.pairs);
  EXPECT_EQ(result.count, whole.count);
  const int all = finds;
  in_parts.find(chain, {.want = Request::Want::any}, result);
  EXPECT_TRUE(result.found);
  EXPECT_LT(finds - all, all / 2) << "one pair is the answer yes";
}

/// The number of spheres that a variant refuses is none of the caller's where images are among them.
TEST(Periodic, SaysHowManyImagesAVariantRefuses) {
  const Chain chain({{0, 0, 0, 1}, {5, 5, 5, 1}, {8.5f, 0, 0, 1}, {5, 0, 0, 1}});
  const auto refusal = [&](const std::string& variant, const PeriodicBox& box) {
    Periodic periodic(StrategyRegistry::instance().make(variant), box);
    try {
      periodic.build(chain);
    } catch (const CapacityError& why) {
      return std::string(why.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("bGPU2@host(block=2)+CPU2", {{90, 90, 90}}), "");
  EXPECT_TRUE(
      refusal("bGPU2@host(block=2)+CPU2", {{10, 0, 0}})
          .ends_with("got 5; use aGPU2@host; in a box 5 spheres are searched, of which 1 is an image at its "
                     "faces"))
      << refusal("bGPU2@host(block=2)+CPU2", {{10, 0, 0}});
  EXPECT_TRUE(refusal("bGPU2@host(block=1)+CPU2", {{90, 90, 90}}).ends_with("got 4; use aGPU2@host"));
}

/// An empty strand of images would have the strands of all spheres looked up.
TEST(Periodic, SearchesOneOpenStrandWithoutImagesAsOne) {
  Periodic periodic(StrategyRegistry::instance().make("auto"), {{90, 90, 90}});
  const Chain chain({{0, 0, 0, 1}, {5, 5, 5, 1}, {1, 0, 0, 1}});
  Collisions result;
  periodic.build(chain);
  periodic.find(chain, {}, result);
  EXPECT_EQ(result.pairs, (Pairs{{0, 2}}));
  const Plan plan = periodic.plan();
  EXPECT_TRUE(std::ranges::find(plan, std::string(strand_table_step), &Decision::step)->left_out);
}

/// For yes or no the chain is searched as it is stored, and its images where they may make a difference.
TEST(Periodic, LooksForImagesWhereTheyDecide) {
  const Request any{.want = Request::Want::any};
  const auto expect = [&](const Chain& chain, const PeriodicBox& box, bool is, bool images) {
    Periodic periodic(StrategyRegistry::instance().make("auto"), box);
    EXPECT_EQ(periodic.answered_by(), "") << "nothing was built";
    periodic.prepare(any);
    periodic.build(chain);
    EXPECT_EQ(periodic.images() > 0, images);
    Collisions result;
    periodic.find(chain, any, result);
    EXPECT_EQ(result.found, is);
    EXPECT_EQ(periodic.answered_by(), "CPU1");
    const auto list = [&](const Plan& plan) {
      return std::ranges::find(plan, info_of(Omission::pair_list).step, &Decision::step)->reason;
    };
    const std::string decided_again = "in a box pairs are searched for, and decided again";
    EXPECT_EQ(list(periodic.plan()) == decided_again, images);
    EXPECT_EQ(periodic.plan().front().step, "images at the faces of the box");
    EXPECT_EQ(periodic.plan().front().left_out, !images);
    if (!images) {
      EXPECT_EQ(periodic.plan().front().reason,
                is ? "what collides as it is stored is the answer" : "no image of the chain reaches another");
    }
    const Request of_the_middle{.want = Request::Want::any, .queries = {1, 2}};
    periodic.prepare(of_the_middle);  // the next one
    periodic.find(chain, of_the_middle, result);
    EXPECT_FALSE(result.found);
    periodic.find(chain, {}, result);
    std::ranges::sort(result.pairs);
    EXPECT_EQ(result.pairs, found("CPU1", chain, box).pairs) << "asked for more than was prepared";
    EXPECT_EQ(periodic.images() > 0, images) << "none where none reaches another";
    periodic.prepare({.want = Request::Want::counts});
    periodic.update(chain, {});
    EXPECT_EQ(list(periodic.plan()), decided_again);
    EXPECT_EQ(periodic.plan().back().reason, "in a box each is searched for itself");
  };
  const auto row = [](float x, float y = 0) { return Chain({{0, 0, 0, 1}, {5, 5, 5, 1}, {x, y, 0, 1}}); };
  expect(row(1.5f), {{10, 10, 10}}, true, false);
  expect(row(8.5f), {{10, 10, 10}}, true, true);
  expect(row(8.5f, 1.9f), {{10, 10, 10}}, false, true);
  expect(row(7.9f), {{10, 10, 10}}, false, false);
}

TEST(Periodic, LeavesNothingOfAnEarlierAnswer) {
  const Chain apart({{0, 0, 0, 1}, {5, 5, 5, 1}, {5, 0, 5, 1}});
  for (const auto want : {Request::Want::any, Request::Want::counts, Request::Want::pairs}) {
    Periodic periodic(StrategyRegistry::instance().make("CPU1"), {{10, 10, 10}});
    periodic.build(apart);
    Collisions result{true, 7, {1, 2, 3, 4}, {{0, 2}}};
    periodic.find(apart, {.want = want}, result);
    EXPECT_FALSE(result.found);
    EXPECT_EQ(result.pair_count, 0u);
    EXPECT_EQ(result.count, std::vector<std::uint32_t>(want == Request::Want::any ? 0 : 3, 0));
    EXPECT_TRUE(result.pairs.empty());
  }
}

TEST(Periodic, RefusesABoxThatIsNone) {
  const Chain chain({{0, 0, 0, 1}, {3, 0, 0, 1}, {5, 0, 0, 1}});
  const auto refusal = [&](const PeriodicBox& box) {
    try {
      found("CPU1", chain, box);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(refusal({{3.9, 9, 9}}).find("the box is 3.9 wide along x, less than twice the reach 2"),
            std::string::npos);
  EXPECT_NE(refusal({{-9, 9, 9}}).find("lengths above 0"), std::string::npos);
  EXPECT_NE(refusal({{0, 0, 0}}).find("lengths above 0"), std::string::npos);
  for (const PeriodicBox& box : {PeriodicBox{{1e-200, 9, 9}},
                                 {{9, 9, 1e200}},
                                 {{9, 9, 9}, 1e-200},
                                 {{9, 9, 9}, 0, 0, -1e200},
                                 {{9, 9, 9}, 0x0.fp-100},
                                 {{9, 9, 0x1.1p100}},
                                 {{9, 9, 9}, 0, -0x0.fp-100}})
    EXPECT_NE(refusal(box).find(" where a length or a tilt is due"), std::string::npos) << refusal(box);
  EXPECT_NE(
      refusal({{1e200, 9, 9}}).find("of a size from 7.888609052210118e-31 to 1.2676506002282294e+30; take"),
      std::string::npos)
      << "what is allowed, to the last digit";
  for (const PeriodicBox& box : {PeriodicBox{{9, 9, 9}, 0x1p-100, -0x1p-100}, {{9, 9, 0x1p100}}})
    EXPECT_EQ(refusal(box), "");
  for (const double none : {double{NAN}, double{INFINITY}})
    for (const PeriodicBox& box : {PeriodicBox{{none, 9, 9}},
                                   {{9, 9, none}},
                                   {{9, 9, 9}, none},
                                   {{9, 9, 9}, 0, none},
                                   {{9, 9, 9}, 0, 0, none}})
      EXPECT_NE(refusal(box).find(" where a length or a tilt is due"), std::string::npos) << refusal(box);
  EXPECT_NE(refusal({{4, 3, 9}, 4}).find("the box is 2.4 wide along x, less"), std::string::npos)
      << "across the tilt";
  EXPECT_EQ(refusal({{9, 900, 900}, 288}), "");
  EXPECT_EQ(refusal({{9, 900, 900}, 0, 0, -28800}), "");
  EXPECT_NE(refusal({{9, 900, 900}, 288.1}).find("tilted by 288.1 along x, more than 32 times its length 9"),
            std::string::npos);
  EXPECT_NE(refusal({{9, 900, 900}, 0, 0, -28801}).find("tilted by -28801 along y"), std::string::npos);
  EXPECT_EQ(refusal({{0, 900, 900}, 1e6}), "") << "along an edge that does not repeat";
  EXPECT_EQ(refusal({{4, 9, 0}}), "");
}

TEST(Periodic, AnswersInTheBoxThatItWasBuiltIn) {
  const Chain chain({{0, 0, 0, 1}, {5, 5, 5, 1}, {9, 0, 0, 1}});
  Periodic periodic(StrategyRegistry::instance().make("CPU1"), {{10, 10, 10}});
  Collisions result;
  periodic.build(chain);
  periodic.set_box({{30, 30, 30}});
  periodic.find(chain, {}, result);
  EXPECT_EQ(result.pairs, (Pairs{{0, 2}}));
  periodic.build(chain);
  periodic.find(chain, {}, result);
  EXPECT_EQ(result.pairs, Pairs{});
}

TEST(Periodic, RefusesAChainThatItWasNotBuiltFor) {
  const Chain two({{0, 0, 0, 1}, {5, 5, 5, 1}}), three({{0, 0, 0, 1}, {5, 5, 5, 1}, {1, 0, 0, 1}});
  Periodic periodic(StrategyRegistry::instance().make("CPU1"), {{10, 10, 10}});
  Collisions result;
  periodic.build(two);
  EXPECT_THROW(periodic.find(three, {}, result), std::logic_error);
  EXPECT_EQ(periodic.timings().find_ms, 0);
  periodic.find(two, {}, result);
  EXPECT_GT(periodic.timings().find_ms, 0);
}

/// Beside a share of 2^-14 and less, which integers hold with every digit.
TEST(PeriodicBox, DecidesByTheLastDigitOfTheSmallestNumbers) {
  const float large = 0x1p-106f, small = 0x1p-120f;
  const PeriodicBox box{{1, 1, 1}};
  for (const float least : {small, 0x1p-129f}) {
    EXPECT_TRUE(image_overlaps_by_integers({0, 0, 0, large}, {large + least, 0, 0, least}, {}, box));
    EXPECT_FALSE(image_overlaps_by_integers({0, 0, 0, large}, {large + least, 0, 0, least / 2}, {}, box));
  }
}

/// Where the place of the image is rounded onto the other centre, nothing but that rounding is left to doubt.
TEST(PeriodicBox, DoubtsADistanceThatIsAllRounding) {
  const PeriodicBox box{{1 + 0x1p-52, 1, 1}};  // three of it are halfway between two numbers
  const Sphere a{3, 0, 0, 0x1p-61f}, b{-0x1p-50f, 0, 0, 0x1p-61f};
  EXPECT_FALSE(image_overlaps_by_integers(a, b, {3, 0, 0}, box)) << "2^-52 apart";
  EXPECT_FALSE(image_overlaps(a, b, {3, 0, 0}, box));
}

TEST(PeriodicBox, IsWrittenWithEveryTilt) {
  EXPECT_EQ(written({{1, 2, 0.5}}), "1,2,0.5");
  EXPECT_EQ(written({{1, 2, 3}, 4, 0, 0}), "1,2,3,4,0,0");
  EXPECT_EQ(written({{1, 2, 3}, 0, -4, 0}), "1,2,3,0,-4,0");
  EXPECT_EQ(written({{1, 2, 3}, 0, 0, 0.1}), "1,2,3,0,0,0.1");
}

}  // namespace
}  // namespace catena
