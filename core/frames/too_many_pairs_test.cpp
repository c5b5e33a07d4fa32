// Frames of which more pairs collide than are kept from one to the next: they are searched as it was asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/frames/frame_search.h"
#include "catena/core/frames/test_yarn.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"

namespace catena {
namespace {

using test::shaken, test::yarn;
using Way = FrameSearch::Way;

/// Whether anything collides, or more pairs than are kept here, is asked of the search as it was asked.
TEST(FrameSearch, AsksForNoPairsWhereTheyAreOfNoUseOrTooMany) {
  const Chain chain = yarn();
  const auto base = StrategyRegistry::instance().make("Hybrid");
  bool flood = false;
  std::vector<Request::Want> asked;
  const FullSearch full = [&](const Chain& c, const Request& r, Collisions& f) {
    asked.push_back(r.want);
    if (flood && r.want == Request::Want::pairs) throw PairLimitExceeded(r.pair_limit + 1, r.pair_limit);
    base->build(c);
    base->find(c, r, f);
  };
  FrameSearch search({}, true);
  search.begin(true);
  Collisions found, exact;
  search.find(chain, {.want = Request::Want::any}, found, full, full, 0);
  EXPECT_TRUE(found.found);
  EXPECT_EQ(asked, std::vector{Request::Want::any});
  full(chain, {.want = Request::Want::counts}, exact);
  flood = true;
  for (const bool kept : {false, true}) {
    asked.clear();
    EXPECT_EQ(search.update(chain, {}), Way::full);
    const Request counts{.want = Request::Want::counts};
    if (kept)
      found = search.find_kept(chain, counts, full, full, 0);
    else
      search.find(chain, counts, found, full, full, 0);
    EXPECT_EQ(found.count, exact.count);
    EXPECT_EQ(found.pair_count, exact.pair_count);
    EXPECT_EQ(asked, (std::vector{Request::Want::pairs, Request::Want::counts}));
  }
  // Too many only when another way has been chosen: no list of thicker spheres, nor the frame's own pairs.
  const auto begin = [&] {
    flood = false;
    search.begin(true);
    search.find(chain, {}, found, full, full, 0);
    asked.clear();
  };
  const auto expect_counts = [&](const Chain& next, const std::vector<Request::Want>& of) {
    search.find(next, {.want = Request::Want::counts}, found, full, full, 0);
    EXPECT_EQ(asked, of);
    EXPECT_EQ(search.way(), Way::full);
    EXPECT_TRUE(found.pairs.empty());
    full(next, {.want = Request::Want::counts}, exact);
    EXPECT_EQ(found.count, exact.count);
  };
  begin();
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  const Chain shaky = chain.moved(shaken(spheres, 0.01f));
  EXPECT_EQ(search.update(shaky, {}), Way::kept_list);
  flood = true;
  expect_counts(shaky, {Request::Want::pairs, Request::Want::pairs, Request::Want::counts});
  begin();
  search.keep_at_most(exact.pair_count);
  for (std::size_t i = 700; i < 760; ++i) spheres[i] = spheres[700];
  const Chain onto_one = chain.moved(spheres);
  EXPECT_EQ(search.update(onto_one, {}), Way::parts);
  expect_counts(onto_one, {Request::Want::counts});
  begin();
  EXPECT_EQ(search.update(onto_one, {}), Way::parts);
  search.find(onto_one, {}, found, full, full, 0);
  EXPECT_EQ(search.way(), Way::parts) << "as many as are asked for are kept";
  EXPECT_TRUE(asked.empty());
  full(onto_one, {}, exact);
  EXPECT_EQ(found.count, exact.count);
}

/// Pairs that are too many to be kept are not looked for in every frame, but again when they are fewer.
TEST(FrameSearch, LooksForTooManyPairsSeldom) {
  const Chain first = yarn();
  std::vector<Sphere> spheres(first.spheres().begin(), first.spheres().end());
  for (const SphereRange& queries : {SphereRange{}, SphereRange{0, 100}}) {
    FrameSearch search({}, false);
    bool flood = true;
    int floods = 0, all = 0;
    const FullSearch full = [&](const Chain& chain, const Request& r, Collisions& found) {
      const Stopwatch watch;
      while (watch.ms() < 0.02) {
      }
      found = {};
      found.count.assign(chain.size(), 0);
      if (r.want == Request::Want::pairs && r.queries == SphereRange{})
        ++(flood ? floods : all);
      else
        found.pair_count = flood ? r.pair_limit + 1 : 0;
      if (flood && r.want == Request::Want::pairs && r.queries == SphereRange{})
        throw PairLimitExceeded(r.pair_limit + 1, r.pair_limit);
    };
    search.begin(true);
    Chain chain = first;
    Collisions found;
    const bool some = queries != SphereRange{};
    const Request request{.want = some ? Request::Want::pairs : Request::Want::counts, .queries = queries};
    const auto film = [&](int frames) {
      for (int k = 0; k < frames; ++k) {
        search.find(chain, request, found, full, full, 0);
        chain = chain.moved(spheres = shaken(spheres, 1));
        search.update(chain, {});
      }
    };
    film(100);
    EXPECT_LE(floods, some ? 20 : 1);
    flood = false;
    film(some ? 0 : 3);
    EXPECT_EQ(all > 0, !some);
  }
}

}  // namespace
}  // namespace catena
