// What ranks find together, on any number of them, and how all end when one fails.
#include "catena/core/ranks/rank_search.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <new>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/ranks/test_chain.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/reference/ranks/verify_answer.h"
#include "catena/reference/reference.h"

namespace catena::ranks {
namespace {

/// What all ranks found, put together.
struct Whole {
  std::vector<std::uint64_t> count;
  std::vector<IdPair> pairs;
  std::uint64_t pair_count = 0;
  std::vector<RankWork> work;
};

using Cut = std::function<Part(Communicator&)>;

Whole searched(unsigned ranks, const RankOptions& options, const Cut& cut) {
  std::vector<RankAnswer> answers(ranks);
  Whole whole;
  whole.work.resize(ranks);
  run_in_threads(
      ranks, [&](Communicator& c) { answers[c.rank()] = search(c, cut(c), options, whole.work[c.rank()]); });
  for (const RankAnswer& answer : answers) {
    whole.count.insert(whole.count.end(), answer.count.begin(), answer.count.end());
    whole.pairs.insert(whole.pairs.end(), answer.pairs.begin(), answer.pairs.end());
    EXPECT_EQ(answer.pair_count, answers[0].pair_count);
    whole.pair_count = answer.pair_count;
  }
  return whole;
}

Cut evenly(const Chain& chain) {
  return [&chain](Communicator& c) { return even_part_of(chain, c.size(), c.rank()); };
}

void expect_exact(const Whole& whole, const Chain& chain, const std::string& what) {
  const reference::Answer exact = reference::find(chain);
  std::vector<IdPair> pairs;
  for (const Pair& p : exact.pairs) pairs.push_back({p.i, p.j});
  EXPECT_GT(exact.pair_count, 0u) << what;
  EXPECT_EQ(whole.pair_count, exact.pair_count) << what;
  EXPECT_EQ(whole.pairs, pairs) << what;
  EXPECT_EQ(whole.count, std::vector<std::uint64_t>(exact.count.begin(), exact.count.end())) << what;
  std::uint64_t found = 0;
  for (const RankWork& work : whole.work) found += work.pairs_within + work.pairs_across;
  EXPECT_EQ(found, exact.pair_count) << what;
}

TEST(RankSearch, FindsWhatOneRankFindsOnOneToSixtyFour) {
  for (const char* input : {"yarn:n=1500", "hair:n=1200", "lattice:n=800"}) {
    const Chain chain = chain_of(input);
    for (const unsigned ranks : {1u, 2u, 3u, 5u, 8u, 16u, 33u, 64u})
      for (const Order order : {Order::chain, Order::space, Order::measured})
        expect_exact(searched(ranks, {.order = order}, evenly(chain)), chain,
                     fmt::format("{} on {}", input, ranks));
  }
}

/// A tube wound five times, perhaps closed: by space each rank gets pieces of every winding, and one gets
/// both ends. Some of what touches are extra pairs.
Chain coil(bool closed, Exclusion rule) {
  constexpr std::uint32_t n = 400, turns = 5;
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * turns * i / n, along = 2 * std::numbers::pi * i / n;
    spheres.push_back({static_cast<float>(9 * std::cos(angle)), static_cast<float>(9 * std::sin(angle)),
                       static_cast<float>(std::sin(along)), 4});
  }
  for (std::uint32_t i = 0; i + n / turns < n; i += 3) rule.extra_pairs.push_back({i, i + n / turns});
  return Chain(std::move(spheres), closed ? Strands::one_closed(n) : Strands{}, std::move(rule));
}

TEST(RankSearch, KnowsNeighboursAcrossPiecesAndAroundTheEnd) {
  for (const Exclusion& rule : {Exclusion::index(1), Exclusion::index(12), Exclusion::index(60),
                                Exclusion::arc(1.5), Exclusion::arc(9)}) {
    for (const bool closed : {false, true}) {
      const Chain chain = coil(closed, rule);
      for (const unsigned ranks : {1u, 2u, 3u, 4u, 7u, 12u})
        for (const Order order : {Order::chain, Order::space})
          expect_exact(searched(ranks, {.order = order}, evenly(chain)), chain,
                       fmt::format("on {} ranks", ranks));
    }
  }
}

/// A coil has neighbours that the parts' chains miss, or pass over; the others have not.
TEST(RankSearch, TellsPairsOfSomeSpheresAlone) {
  const Chain yarn = chain_of("yarn:n=900"), open = coil(false, Exclusion::index(12)),
              closed = coil(true, Exclusion::index(1));
  for (const Chain* chain : {&yarn, &open, &closed}) {
    const reference::Answer exact = reference::find(*chain);
    const SphereId n = chain->size();
    for (const IdRange& range :
         {IdRange{0, n / 2}, IdRange{n / 3, n / 3 + 1}, IdRange{n / 2, n}, IdRange{n, n}})
      for (const unsigned ranks : {1u, 3u, 5u})
        for (const Order order : {Order::chain, Order::space}) {
          std::vector<IdPair> pairs;
          for (const auto& [i, j] : exact.pairs)
            if (range.contains(i)) pairs.push_back({i, j});
          RankOptions options{.order = order, .pairs_of = range};
          const Whole whole = searched(ranks, options, evenly(*chain));
          EXPECT_EQ(whole.pairs, pairs);
          EXPECT_EQ(whole.pair_count, pairs.size());
          EXPECT_EQ(whole.count, std::vector<std::uint64_t>(exact.count.begin(), exact.count.end()));
          options.request.want = Request::Want::any;
          run_in_threads(ranks, [&](Communicator& c) {
            RankWork work;
            EXPECT_EQ(search(c, evenly(*chain)(c), options, work).found, !pairs.empty());
          });
        }
  }
}

TEST(RankSearch, KeepsToTheLimitOfAllRanks) {
  const Chain chain = chain_of("coincident:n=60");
  for (const std::uint64_t limit : {0u, 100u, 811u, 812u}) {
    const Whole whole = searched(3, {.request = {.pair_limit = limit}}, evenly(chain));
    EXPECT_EQ(whole.pair_count, 812u);
    EXPECT_EQ(whole.pairs.size(), limit < 812 ? 0u : 812u);
    EXPECT_EQ(std::accumulate(whole.count.begin(), whole.count.end(), std::uint64_t{0}), 2u * 812);
  }
}

/// Whatever a rank does in whatever phase: all end, and say the same.
TEST(RankSearch, EndsOnAllRanksWhenOneFails) {
  const Chain chain = chain_of("yarn:n=600");
  for (const Phase phase : {Phase::take_part, Phase::order, Phase::repartition, Phase::build, Phase::within,
                            Phase::across, Phase::answers, Phase::done})
    for (unsigned failing = 0; failing < 4; ++failing) {
      std::vector<std::string> said(4);
      run_in_threads(4, [&](Communicator& c) {
        RankOptions options{.order = Order::space};
        options.entering = [&](Phase at) {
          if (at == phase && c.rank() == failing) throw InputError("no more");
          if (at == phase && c.rank() == 3) throw std::bad_alloc();
        };
        RankWork work;
        try {
          search(c, evenly(chain)(c), options, work);
        } catch (const RankFailed& failed) {
          said[c.rank()] = failed.what();
        }
      });
      const std::string first = fmt::format("rank {} of 4: {}", failing, "no more");
      for (unsigned rank = 0; rank < 4; ++rank)
        EXPECT_EQ(said[rank].substr(0, 10), first.substr(0, 10))
            << name_of(phase) << ": rank " << rank << " says " << said[rank];
      if (failing < 3) {
        EXPECT_EQ(said[failing], first);
      }
    }
}

TEST(RankSearch, ComparesWithTheReference) {
  const Chain chain = chain_of("yarn:n=500");
  run_in_threads(3, [&](Communicator& c) {
    RankWork work;
    RankAnswer answer = search(c, evenly(chain)(c), {}, work);
    const auto whole = [&] { return c.rank() == 0 ? std::optional<Chain>(chain) : std::nullopt; };
    EXPECT_TRUE(compare_with_reference(c, whole(), answer).right());
    RankAnswer less = answer, again = answer, more = answer, miscounted = answer;
    if (c.rank() == 1)
      less.pairs.pop_back(), again.pairs.push_back(again.pairs[0]), more.pairs.push_back({300, 302});
    if (c.rank() == 2) ++miscounted.count[0];
    EXPECT_EQ(compare_with_reference(c, whole(), less).missing, 1u);
    EXPECT_EQ(compare_with_reference(c, whole(), again).repeated, 1u);
    const RankComparison invented = compare_with_reference(c, whole(), more);
    EXPECT_EQ(invented.invented + invented.repeated, 1u);
    EXPECT_EQ(compare_with_reference(c, whole(), miscounted).wrong_counts, 1u);
    // Of every rank, and what all say alike.
    RankAnswer uncounted = answer, unsure = answer, of_more = answer;
    uncounted.count.pop_back();
    EXPECT_EQ(compare_with_reference(c, whole(), uncounted).wrong_counts, 3u);
    unsure.found = c.rank() == 2;
    EXPECT_FALSE(compare_with_reference(c, whole(), unsure).right());
    of_more.pair_count += c.rank() == 0;
    EXPECT_FALSE(compare_with_reference(c, whole(), of_more).right());
  });
}

TEST(RankComparison, IsRightWhereNothingDiffersAndNoneMakesUpForAnother) {
  for (unsigned differs = 0; differs < 32; ++differs) {
    const auto has = [&](unsigned bit) { return std::uint64_t{differs >> bit & 1}; };
    const RankComparison wrong{has(0), has(1), has(2), has(3), has(4) != 0};
    EXPECT_EQ(wrong.right(), differs == 0) << differs;
  }
}

}  // namespace
}  // namespace catena::ranks
