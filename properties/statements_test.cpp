#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/properties/testing/faulty.h"

// Each clause of each statement fails for a variant that breaks it and nothing else: the museum's mutants
// break many at once, so that one which cannot fail any more would not be missed.
namespace catena::properties {
namespace {

TEST(Statements, NoticeAnAnswerToAChainThatWasNotBuilt) {
  const auto answers = [](bool built) {
    return Faulty::Fault{.instead = [=](const Question& q, Collisions& found) {
      if ((q.told.chain != nullptr) != built || (built && q.told.chain->size() == q.chain.size()))
        return false;
      found = {false, 0, std::vector<std::uint32_t>(q.chain.size(), 0), {}};
      return true;
    }};
  };
  expect_noticed("build first", answers(false), "never built: an answer");
  expect_noticed("build first", answers(true), "built on another chain: an answer");
}

TEST(Statements, NoticeAnswersThatChange) {
  const auto where = [](auto when) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (when(q.told)) drop_a_pair(found);
    }};
  };
  expect_noticed("same answer again", where([](const Told& t) { return t.builds == 2; }),
                 "in the second run");
  expect_noticed("same answer again",
                 where([objects = std::make_shared<std::vector<const Told*>>()](const Told& t) {
                   if (std::ranges::find(*objects, &t) == objects->end()) objects->push_back(&t);
                   return &t != objects->front();
                 }),
                 "from a fresh object");
  expect_noticed("same answer again", where([](const Told& t) { return t.builds == 4; }),
                 "after another chain");
}

TEST(Statements, NoticeWrongPairsAndCounts) {
  const auto spoilt = [](auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question&, Collisions& found) { spoil(found); }};
  };
  expect_noticed("pair set", spoilt(drop_a_pair), "1 pairs missing");
  expect_noticed("pair set", spoilt([](Collisions& found) { ++found.count[0]; }), "1 counts wrong");
  expect_noticed("pair set", spoilt([](Collisions& found) { ++found.pair_count; }), "0 counts wrong");
  const auto repeats = [](Collisions& found) { found.pairs.push_back(found.pairs[0]), ++found.pair_count; };
  expect_noticed("pair set", spoilt(repeats), "1 repeated");
  expect_noticed("pair set", spoilt(repeats), "1 repeated", row(), rounded());
  EXPECT_EQ(asked("pair set", spoilt(drop_a_pair), row(), rounded()), std::nullopt);
}

TEST(Statements, NoticeAPairThatIsLostInAChangedChain) {
  for (const char* relation :
       {"permuted and negated axes", "first part on its own", "second part on its own", "relabelled strands",
        "reversed chain", "scaling by a power of two", "subdivision", "exact translation"}) {
    const Case test = row(true);
    const auto elsewhere = [&](const Question& q) {
      return !std::ranges::equal(q.chain.spheres(), test.chain.spheres());
    };
    expect_noticed(relation,
                   {.spoil =
                        [&](const Question& q, Collisions& found) {
                          if (elsewhere(q)) drop_a_pair(found);
                        }},
                   "is missing", test);
    expect_noticed(relation,
                   {.spoil =
                        [&](const Question& q, Collisions& found) {
                          if (elsewhere(q)) found.pairs.push_back({0, q.chain.size() - 1});
                        }},
                   "is invented", test);
    // As many, but others.
    expect_noticed(relation,
                   {.spoil =
                        [&](const Question& q, Collisions& found) {
                          if (elsewhere(q) && !found.pairs.empty()) found.pairs[0] = {0, q.chain.size() - 1};
                        }},
                   " of the changed chain is ", test);
  }
  const Case test = row();
  expect_noticed("larger radii only add pairs",
                 {.spoil =
                      [&](const Question& q, Collisions& found) {
                        std::erase(found.pairs, test.exact.pairs.front());
                        static_cast<void>(q);
                      }},
                 "are left", test);
  // Some radii grow by more than the last bit.
  expect_noticed("larger radii only add pairs",
                 {.spoil =
                      [&](const Question& q, Collisions& found) {
                        if (q.chain[1].radius > 1.2f * test.chain[1].radius)
                          std::erase(found.pairs, test.exact.pairs.front());
                      }},
                 "are left", test);
}

/// Of spheres without a radius each meets its copy, and no window excludes that.
TEST(Statements, SubdivideAnArcOfPoints) {
  const std::vector<Sphere> points{{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}, {2, 0, 0, 0}};
  EXPECT_EQ(asked("subdivision", {}, Case::of(Chain(points, {}, Exclusion::arc(1.5)))), std::nullopt);
}

TEST(Statements, NoticeWhatIsWrongOfAFloatingPointEnvironment) {
  expect_noticed("any floating-point environment",
                 {.begin = [](const Told&) { std::fesetround(FE_TONEAREST); }}, "environment is lost");
  for (const int rounding : {FE_UPWARD, FE_TOWARDZERO})
    expect_noticed("any floating-point environment",
                   {.spoil =
                        [=](const Question&, Collisions& found) {
                          if (std::fegetround() == rounding) drop_a_pair(found);
                        }},
                   "another answer");
  expect_noticed("any floating-point environment",
                 {.begin =
                      [](const Told& told) {
                        if (told.updates > 0) std::fesetround(FE_TONEAREST);
                      }},
                 "environment is lost");
}

TEST(Statements, NoticeWhatIsWrongPastALimitOnPairs) {
  const std::uint64_t pairs = row().exact.pair_count;
  ASSERT_GT(pairs, 3u);
  const auto wrong = [&](auto when, auto instead) {
    return Faulty::Fault{.instead = [=](const Question& q, Collisions& found) {
      if (!when(q.request)) return false;
      const auto honest = StrategyRegistry::instance().make("CPU1");
      honest->build(q.chain);
      Request unlimited = q.request;
      unlimited.pair_limit = Request().pair_limit;
      honest->find(q.chain, unlimited, found);
      instead(q.request, found);
      return true;
    }};
  };
  const auto limit = [](std::uint64_t at) {
    return [=](const Request& r) { return r.want == Want::pairs && r.pair_limit == at; };
  };
  const auto nothing = [](const Request&, Collisions&) {};
  for (const std::uint64_t at : {pairs - 1, pairs / 2, std::uint64_t{0}})
    expect_noticed("pair limit", wrong(limit(at), nothing), "pass a limit of " + std::to_string(at));
  expect_noticed("pair limit",
                 wrong(limit(pairs / 2),
                       [=](const Request& r, Collisions& found) {
                         found.pairs.clear();
                         throw PairLimitExceeded(pairs - 1, r.pair_limit);
                       }),
                 "says");
  expect_noticed("pair limit",
                 wrong(limit(pairs / 2),
                       [=](const Request& r, Collisions&) { throw PairLimitExceeded(pairs, r.pair_limit); }),
                 "past the limit");
  expect_noticed("pair limit",
                 wrong([](const Request& r) { return r.want == Want::counts; },
                       [](const Request&, Collisions& found) { ++found.count[0]; }),
                 "counts differ");
  expect_noticed("pair limit",
                 wrong(limit(pairs), [](const Request&, Collisions& found) { found.pairs.pop_back(); }),
                 "pairs differ");
}

TEST(Statements, NoticeWhatIsWrongOfAPartOfTheSpheres) {
  const auto part = [](Want want, auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (q.request.want == want && q.request.queries != SphereRange{}) spoil(q.request, found);
    }};
  };
  const auto with_pairs = [&](auto spoil) { return part(Want::pairs, spoil); };
  expect_noticed("query ranges", with_pairs([](const Request& r, Collisions& found) {
                   found.count[r.queries.contains(0) ? 23 : 0] = 1;
                 }),
                 "was not asked about");
  expect_noticed(
      "query ranges", with_pairs([](const Request& r, Collisions& found) {
        found.pairs.push_back(r.queries.contains(0) ? Pair{20, 22} : Pair{0, 2}), ++found.pair_count;
      }),
      "was not asked about");
  expect_noticed("query ranges", with_pairs([](const Request&, Collisions& found) { ++found.pair_count; }),
                 "but pair_count");
  expect_noticed("query ranges", with_pairs([](const Request&, Collisions& found) {
                   if (!found.pairs.empty()) found.pairs.pop_back(), --found.pair_count;
                 }),
                 "or others");
  expect_noticed("query ranges", with_pairs([](const Request& r, Collisions& found) {
                   if (r.queries.contains(0)) ++found.count[0];
                 }),
                 "counts by parts");
  expect_noticed("query ranges",
                 part(Want::any, [](const Request&, Collisions& found) { found.found = !found.found; }),
                 "says found");
}

TEST(Statements, NoticeRequestsThatDisagree) {
  const auto where = [](Want prepared, Want want, auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (q.told.prepared.want == prepared && q.request.want == want) spoil(found);
    }};
  };
  const auto other_answer = [](Collisions& found) { found.found = !found.found; };
  const auto other_count = [](Collisions& found) { ++found.count[0]; };
  expect_noticed("requests agree", where(Want::pairs, Want::any, other_answer), "found differs when less");
  expect_noticed("requests agree",
                 where(Want::pairs, Want::any, [](Collisions& found) { found.count.push_back(1); }),
                 "counts of an earlier answer");
  expect_noticed("requests agree", where(Want::pairs, Want::counts, other_count), "counts differ when less");
  expect_noticed("requests agree",
                 where(Want::pairs, Want::pairs, [](Collisions& found) { found.pairs.pop_back(); }),
                 "but pair_count");
  expect_noticed("requests agree", where(Want::counts, Want::counts, other_count), "counts differ between");
  expect_noticed("requests agree",
                 where(Want::counts, Want::counts, [](Collisions& found) { ++found.pair_count; }),
                 "with counts");
  for (const Want want : {Want::any, Want::counts})
    expect_noticed("requests agree", where(want, want, other_answer), "but found is");
  for (const Want want : {Want::any, Want::counts})
    expect_noticed("requests agree",
                   where(want, want,
                         [](Collisions& found) {
                           found.pairs = {{0, 2}};
                         }),
                   "nobody asked for");
}

TEST(Statements, NoticeWhatIsWrongOfBounds) {
  const Case test = row();
  const auto shown = [](auto show) {
    return Faulty::Fault{
        .bounds = [=](const Told& told, BoundsVisitor& visitor) { show(*told.chain, visitor); }};
  };
  EXPECT_EQ(asked("enclosure", shown([](const Chain& c, BoundsVisitor& v) { show_twos(c, v, 3); }), test),
            std::nullopt);
  expect_noticed("enclosure", shown([](const Chain& c, BoundsVisitor& v) { show_twos(c, v, 1.5); }),
                 "do not enclose");
  expect_noticed("enclosure", shown([](const Chain& c, BoundsVisitor& v) {
                   v.edge(c.size(), Sphere64{0, 0, 0, 99}, 0, Sphere64{0, 0, 0, 9});
                 }),
                 "are not the chain's spheres");
  expect_noticed("enclosure", shown([](const Chain& c, BoundsVisitor& v) {
                   v.tree({.nested = false});
                   for (const double radius : {99, 98})
                     v.edge(c.size(), Sphere64{0, 0, 0, radius}, 0, Everything{});
                 }),
                 "not one place and bound");
}

}  // namespace
}  // namespace catena::properties
