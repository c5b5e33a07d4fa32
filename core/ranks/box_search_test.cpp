#include "catena/core/ranks/box_search.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>

#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/reference/find_in_box.h"
#include "catena/reference/ranks/verify_answer.h"

namespace catena::ranks {
namespace {

Chain scattered(std::uint32_t n, double box, std::uint32_t seed, float radius, Exclusion rule) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-0.5f * static_cast<float>(box),
                                              1.5f * static_cast<float>(box));
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i)
    spheres.push_back({place(random), place(random), place(random), radius * static_cast<float>(i % 3) / 2});
  return Chain(std::move(spheres), {{0, n / 3, n}, {1, 0}}, std::move(rule));
}

// By any number of ranks, more than spheres too, and whatever is asked for.
TEST(BoxSearch, AnswersAsTheReference) {
  Exclusion extra = Exclusion::index(2);
  extra.extra_pairs = {{0, 5}};
  for (const auto& [n, radius] : {std::pair(5u, 2.4f), std::pair(300u, 1.0f)})
    for (const Exclusion& rule : {Exclusion::index(1), extra, Exclusion::arc(1.5)})
      for (const PeriodicBox& box : {PeriodicBox{{10, 11, 12}}, PeriodicBox{{10, 0, 12}, 2, 1, -3}})
        for (const unsigned ranks : {1u, 3u, 7u}) {
          const Chain chain = scattered(n < 6 ? 6 : n, 10, n + ranks, radius, rule);
          const reference::Answer exact = reference::find_in(chain, &box);
          EXPECT_TRUE(n < 6 || exact.pair_count > 0);
          run_in_threads(ranks, [&](Communicator& c) {
            const std::optional<Chain> whole = c.rank() == 0 ? std::optional(chain) : std::nullopt;
            RankWork work;
            RankOptions options{.variant = "Hybrid", .order = n > 6 ? Order::space : Order::measured};
            const RankAnswer answer = search_in_box(c, whole, box, options, work);
            const RankComparison wrong = compare_with_reference(c, whole, answer, &box);
            EXPECT_TRUE(wrong.right()) << wrong.missing << ' ' << wrong.invented << ' ' << wrong.wrong_counts;
            options.request.want = Request::Want::counts;
            const RankAnswer counts = search_in_box(c, whole, box, options, work);
            EXPECT_EQ(counts.count, answer.count);
            EXPECT_TRUE(counts.pairs.empty());
            options.request.want = Request::Want::any;
            EXPECT_EQ(search_in_box(c, whole, box, options, work).found, exact.pair_count > 0);
            options.request = {.want = Request::Want::pairs, .pair_limit = 0};
            const RankAnswer limited = search_in_box(c, whole, box, options, work);
            EXPECT_EQ(limited.pair_count, exact.pair_count);
            EXPECT_TRUE(limited.pairs.empty());
          });
        }
}

/// For yes or no ranks stop at a pair, and a chain that is short beside its box gets no images, of which each
/// two would be found, too.
TEST(BoxSearch, SearchesForNoMoreThanIsAsked) {
  constexpr std::uint32_t n = 600, pairs = (n - 1) * (n - 2) / 2;  // each touches all, but for its neighbours
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({1e-3f * static_cast<float>(i), 0, 0, 1});
  const Chain clump(std::move(spheres));
  for (const Request::Want want : {Request::Want::any, Request::Want::counts})
    run_in_threads(3, [&](Communicator& c) {
      const std::optional<Chain> whole = c.rank() == 0 ? std::optional(clump) : std::nullopt;
      RankWork work;
      const RankOptions options{.variant = "Hybrid", .request = {.want = want}};
      EXPECT_TRUE(search_in_box(c, whole, {{100, 100, 100}}, options, work).found);
      std::uint64_t found = 0;
      for (const std::uint64_t of_rank : all_gather_value(c, work.pairs_within + work.pairs_across))
        found += of_rank;
      if (want == Request::Want::any)
        EXPECT_LT(found, pairs / 2);
      else
        EXPECT_EQ(found, pairs);
    });
}

TEST(BoxSearch, EndsOnAllRanksWhereTheBoxIsTooNarrow) {
  run_in_threads(3, [](Communicator& c) {
    std::optional<Chain> whole;
    if (c.rank() == 0) whole = scattered(9, 10, 1, 4, Exclusion::index(1));
    try {
      together(c, [&] {
        RankWork work;
        search_in_box(c, whole, {{10, 10, 10}}, {}, work);
      });
      ADD_FAILURE() << "rank " << c.rank();
    } catch (const RankFailed& error) {
      EXPECT_NE(std::string(error.what()).find("rank 0 of 3: the box is 10 wide"), std::string::npos);
    }
  });
}

}  // namespace
}  // namespace catena::ranks
