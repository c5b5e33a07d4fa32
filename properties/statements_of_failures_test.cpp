// As statements_test.cpp, of calls that fail.
#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/properties/failing_allocations.h"
#include "catena/properties/testing/faulty.h"

namespace catena::properties {
namespace {

constexpr const char* some_fail = "calls in any order, some of which fail";

/// In one of some scripts, as none has room for every call.
void expect_noticed_in_some(const Faulty::Fault& fault, const std::string& words) {
  std::string noticed;
  for (std::uint32_t n = 8; n < 40; ++n) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 1.25f});
    const Case test = Case::of(Chain(std::move(spheres)));
    EXPECT_EQ(asked(some_fail, {}, test), std::nullopt);
    noticed += asked(some_fail, fault, test).value_or("") + "\n";
  }
  EXPECT_NE(noticed.find(words), std::string::npos) << "not '" << words << "', but:\n" << noticed;
}

/// Refuses every third chain; `failed` says whether the last one was.
Faulty::Fault refusing(const std::shared_ptr<bool>& failed) {
  return {.begin = [failed, begun = 0](const Told&) mutable {
    *failed = ++begun % 3 == 0;
    if (*failed) throw CapacityError("every third chain is refused");
  }};
}

TEST(Statements, NoticeWhatARefusedChainLeaves) {
  const auto failed = std::make_shared<bool>();
  EXPECT_EQ(asked(some_fail, refusing(failed), row()), std::nullopt) << "a refusal alone is none";
  Faulty::Fault answers = refusing(failed);
  answers.instead = [=](const Question& q, Collisions& found) {
    if (*failed) found = {false, 0, std::vector<std::uint32_t>(q.chain.size(), 0), {}};
    return *failed;
  };
  expect_noticed_in_some(answers, "found is false, with");
  Faulty::Fault shows = refusing(failed);
  shows.bounds = [](const Told& told, BoundsVisitor& visitor) { show_twos(*told.chain, visitor, 1e9); };
  expect_noticed_in_some(shows, "bounds are shown, and nothing is built");
}

TEST(Statements, NoticeWhatIsWrongAmongCallsInAnyOrder) {
  expect_noticed_in_some(
      {.bounds = [](const Told& told, BoundsVisitor& visitor) { show_twos(*told.chain, visitor, 1e-9); }},
      "bounds do not enclose");
  expect_noticed_in_some({.spoil =
                              [](const Question&, Collisions& found) {
                                if (!found.count.empty()) ++found.count[0];
                              }},
                         "other counts");
  const auto leaves_pairs = [](const Question& q, Collisions& found) {
    if (q.request.want != Want::pairs || q.request.pair_limit == Request().pair_limit) return false;
    const auto honest = StrategyRegistry::instance().make("CPU1");
    honest->build(q.chain);
    Request unlimited = q.request;
    unlimited.pair_limit = Request().pair_limit;
    honest->find(q.chain, unlimited, found);
    if (found.pair_count > q.request.pair_limit)
      throw PairLimitExceeded(found.pair_count, q.request.pair_limit);
    return true;
  };
  expect_noticed_in_some({.instead = leaves_pairs}, "pairs are left past the limit");
}

TEST(Statements, NoticeWhatAFailedSearchLeaves) {
  const auto failed = std::make_shared<bool>();
  const auto past_the_limit = [=](const Question& q, Collisions&) {
    *failed = *failed || q.request.pair_limit < 10;
    return false;
  };
  const auto forgets = [=](const Question&, Collisions& found) {
    if (!found.pairs.empty() && std::exchange(*failed, false)) drop_a_pair(found);
  };
  expect_noticed_in_some({.spoil = forgets, .instead = past_the_limit}, "exactly");
  if (!FailingAllocations::possible()) GTEST_SKIP() << "memory is never wanting";
  const auto without_memory = [=](const Question&, Collisions&) {
    try {
      ::operator delete(::operator new(8));
    } catch (const std::bad_alloc&) {
      *failed = true;
      throw;
    }
    return false;
  };
  *failed = false;
  expect_noticed_in_some({.spoil = forgets, .instead = without_memory}, "exactly");
  *failed = false;
  const auto refuses = [=](const Question& q, Collisions& found) {
    if (std::exchange(*failed, false)) throw std::logic_error("find: not the chain of the last build");
    return without_memory(q, found);
  };
  expect_noticed_in_some({.instead = refuses}, "refuses the chain that is built");
}

}  // namespace
}  // namespace catena::properties
