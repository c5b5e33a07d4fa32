#include "catena/core/plan/find.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

using Want = Request::Want;

TEST(Find, AnswersInOneCallWhateverIsLeftOut) {
  for (const char* input : {"path1:n=20", "yarn:n=700", "yarn:n=9000", "coil:n=9000", "path2:n=9000"}) {
    const Chain chain = open_input(input).animation->frame(0);
    const auto full = StrategyRegistry::instance().make("CPU1");
    Collisions exact;
    full->build(chain);
    full->find(chain, {}, exact);
    Collisions all = find(chain);
    std::ranges::sort(all.pairs);
    std::ranges::sort(exact.pairs);
    EXPECT_EQ(all.pairs, exact.pairs) << input;
    EXPECT_EQ(all.count, exact.count) << input;
    EXPECT_EQ(find(chain, {Want::any}).found, exact.found) << input;
    EXPECT_EQ(find(chain, {Want::counts}).count, exact.count) << input;
    EXPECT_TRUE(find(chain, {Want::counts}).pairs.empty()) << input;
    const SphereRange some{0, chain.size() / 2};
    Collisions of_some = find(chain, {.queries = some});
    std::ranges::sort(of_some.pairs);
    std::vector<Pair> expected;
    for (const Pair& p : exact.pairs)
      if (some.contains(p.i)) expected.push_back(p);
    EXPECT_EQ(of_some.pairs, expected) << input;
    if (exact.pair_count > 0) {
      EXPECT_THROW(find(chain, {.pair_limit = exact.pair_count - 1}), PairLimitExceeded) << input;
    }
    for (const std::string& name : omission_names()) {
      const auto kept = StrategyRegistry::instance().make("auto(keep=" + name + ")");
      for (const Want want : {Want::any, Want::counts, Want::pairs}) {
        Collisions found;
        kept->prepare({want});
        kept->build(chain);
        kept->find(chain, {want}, found);
        EXPECT_EQ(found.found, exact.found) << input << ' ' << name;
        if (want != Want::any) {
          EXPECT_EQ(found.count, exact.count) << input << ' ' << name;
        }
        std::ranges::sort(found.pairs);
        EXPECT_EQ(found.pairs, want == Want::pairs ? exact.pairs : std::vector<Pair>{})
            << input << ' ' << name;
      }
    }
  }
}

}  // namespace
}  // namespace catena
