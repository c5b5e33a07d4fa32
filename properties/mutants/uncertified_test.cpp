#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/mutants/chains_to_kill.h"
#include "catena/reference/certificate.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"

// A search that loses a pair has no certificate: what its evidence says is held to exact arithmetic and to
// all pairs, so that a bug in what the search looked into cannot be told away.
namespace catena::properties {
namespace {

std::vector<testing::NamedChain> chains() {
  auto all = testing::chains_to_kill().chains;
  for (const char* input :
       {"yarn:n=6000", "mixed_radii:n=3000", "cluster:n=3000", "stretched:n=6000", "hair:n=6000"})
    all.push_back({input, open_input(input).animation->frame(0)});
  return all;
}

TEST(Uncertified, IsASearchThatLosesAPair) {
  const auto all = chains();
  std::vector<reference::Answer> right;
  for (const auto& [name, chain] : all) right.push_back(reference::find(chain));
  for (const std::string mutant :
       {"cells-forget-a-corner", "cells-never-look-into-coarser", "cells-level-box-too-small",
        "cells-look-into-a-row-twice", "cells-reach-without-the-other", "space-box-too-small",
        "last-block-not-sorted", "space-drops-its-last-row", "dense-left-alone", "crowd-handed-to-no-one",
        "last-dense-block-not-in-cells", "hashed-cells-look-into-a-row-twice",
        "hashed-cells-forget-the-coarsest"}) {
    const auto variant = StrategyRegistry::instance().make("mutant:" + mutant);
    ASSERT_NE(variant->evidence(), Accounting::none) << mutant;
    std::uint32_t lost = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      Collisions found;
      const reference::Certified certified = reference::certify(*variant, all[k].chain, {}, found);
      if (reference::compare(all[k].chain, right[k], found).right()) continue;
      ++lost;
      EXPECT_FALSE(certified.report.holds()) << mutant << " on " << all[k].name;
    }
    EXPECT_GT(lost, 0u) << mutant << " loses nothing on these chains";
  }
}

}  // namespace
}  // namespace catena::properties
