#include "catena/core/ranks/core_share.h"

#include <gtest/gtest.h>

#include <vector>

namespace catena::ranks {
namespace {

Cores from_to(std::size_t begin, std::size_t end) {
  Cores cores;
  for (std::size_t core = begin; core < end; ++core) cores.set(core);
  return cores;
}

TEST(CoreShare, IsEvenAmongRanksThatMayRunAnywhere) {
  for (const std::size_t cores : {1u, 2u, 16u, 96u, 1024u})
    for (const std::size_t ranks : {1u, 2u, 3u, 7u, 16u, 49u, 200u}) {
      const std::vector<Cores> machine(ranks, from_to(0, cores));
      for (const std::size_t own : {std::size_t{0}, ranks - 1})
        EXPECT_EQ(core_share(machine, own), std::max<std::size_t>(1, cores / ranks)) << cores << ' ' << ranks;
    }
}

TEST(CoreShare, IsAllOfWhatARankIsBoundToAlone) {
  const std::vector<Cores> machine{from_to(0, 1), from_to(1, 2), from_to(2, 8)};
  EXPECT_EQ(core_share(machine, 0), 1u);
  EXPECT_EQ(core_share(machine, 1), 1u);
  EXPECT_EQ(core_share(machine, 2), 6u);
}

TEST(CoreShare, IsEvenWithinASocket) {
  const std::vector<Cores> machine{from_to(0, 8), from_to(8, 16), from_to(0, 8), from_to(0, 8)};
  EXPECT_EQ(core_share(machine, 0), 2u);
  EXPECT_EQ(core_share(machine, 1), 8u);
}

TEST(CoreShare, CountsWhatOnlySomeShare) {
  const std::vector<Cores> machine{from_to(0, 4), from_to(2, 4)};
  EXPECT_EQ(core_share(machine, 0), 3u);
  EXPECT_EQ(core_share(machine, 1), 1u);
  EXPECT_EQ(core_share(std::vector<Cores>(1), 0), 1u);  // where the system does not say
}

}  // namespace
}  // namespace catena::ranks
