#include "catena/core/ranks/space_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/hierarchy/box_around.h"
#include "catena/core/input/input.h"
#include "catena/core/ranks/block.h"
#include "catena/core/ranks/test_chain.h"
#include "catena/core/ranks/thread_ranks.h"

namespace catena::ranks {
namespace {

/// The parts that so many ranks get, by their numbers.
std::vector<Part> parts_in_space(const Chain& chain, unsigned ranks, std::uint32_t blocks_at_once = 0) {
  std::vector<Part> parts(ranks);
  run_in_threads(ranks, [&](Communicator& c) {
    parts[c.rank()] = part_in_space(c, even_part_of(chain, ranks, c.rank()), blocks_at_once);
  });
  return parts;
}

/// Around the spheres that tell where the part's blocks are.
Box middles_of(const Part& part) {
  std::vector<Sphere> middles;
  for_each_block(part.pieces, [&](const Block& block) {
    middles.push_back(middle_of(part.spheres, block));
    middles.back().radius = 0;
  });
  return box_around(middles);
}

/// A cube of 32^3 spheres is cut along planes: no part has a block beyond one, which would cost it a box of
/// twice the size.
TEST(PartInSpace, IsACubeWhereThatIsEven) {
  const Chain chain = chain_of("serpentine:side=32,reach=1");
  for (const unsigned ranks : {2u, 4u, 8u}) {
    const std::vector<Part> parts = parts_in_space(chain, ranks);
    for (unsigned a = 0; a < ranks; ++a) {
      EXPECT_EQ(parts[a].spheres.size(), chain.size() / ranks) << a << " of " << ranks;
      for (unsigned b = a + 1; b < ranks; ++b)
        EXPECT_FALSE(middles_of(parts[a]).meets(middles_of(parts[b]))) << a << ", " << b << " of " << ranks;
    }
  }
}

/// Each sphere is on one rank, and no rank has many more than others, however they lie: few blocks, many in
/// one place, and a tangle.
TEST(PartInSpace, SharesOutAllSpheresEvenly) {
  for (const std::string spec :
       {"path1:n=100", "yarn:n=30000", "coincident:n=4000,together=500", "stretched:n=20000", "rod:n=3"}) {
    const Chain chain = chain_of(spec);
    for (const unsigned ranks : {2u, 3u, 7u, 16u}) {
      const std::vector<Part> parts = parts_in_space(chain, ranks);
      std::vector<int> held(chain.size(), 0);
      std::size_t most = 0;
      for (const Part& part : parts) {
        most = std::max(most, part.spheres.size());
        for (const Piece& piece : part.pieces)
          for (std::uint32_t k = 0; k < piece.size; ++k) {
            ++held[piece.first + k];
            EXPECT_EQ(part.spheres[piece.begin + k], chain[static_cast<std::uint32_t>(piece.first + k)]);
          }
      }
      EXPECT_TRUE(std::ranges::all_of(held, [](int times) { return times == 1; })) << spec << ", " << ranks;
      // A thirty-second of a share, and the blocks between two that each rank samples, at either end.
      const double share = static_cast<double>(chain.size()) / ranks;
      EXPECT_LE(static_cast<double>(most), share * 1.05 + 2 * Block::most * (ranks + 1))
          << spec << ", " << ranks;
    }
  }
}

/// Where all are is told by some blocks. One far beyond these goes where the nearest corner does.
TEST(PartInSpace, TakesABlockThatLiesBeyondAllThatWereLookedAt) {
  const Chain yarn = chain_of("yarn:n=150000");
  for (const unsigned ranks : {2u, 4u})
    for (const float far : {-1e30f, 1e30f}) {
      std::vector<Sphere> spheres(yarn.spheres().begin(), yarn.spheres().end());
      for (std::uint32_t k = 0; k < Block::most; ++k) spheres[k] = {far, far, far, 1};
      const std::vector<Part> parts = parts_in_space(Chain(std::move(spheres)), ranks);
      const std::size_t goal = far < 0 ? 0 : ranks - 1;
      for (std::size_t r = 0; r < ranks; ++r) {
        EXPECT_NEAR(static_cast<double>(parts[r].spheres.size()), 150'000 / ranks, 7500 / ranks) << r;
        EXPECT_EQ(std::ranges::count(parts[r].spheres, far, &Sphere::x), r == goal ? Block::most : 0) << r;
      }
    }
}

/// However few blocks are sent at a time, runs that a round ends in are sent to their end.
TEST(PartInSpace, IsTheSameInAnyNumberOfRounds) {
  const Chain yarn = chain_of("yarn:n=3000");
  const Chain chain({yarn.spheres().begin(), yarn.spheres().end()}, {}, Exclusion::arc(1.5));
  for (const unsigned ranks : {2u, 3u, 5u}) {
    const std::vector<Part> at_once = parts_in_space(chain, ranks);
    for (const std::uint32_t blocks : {1u, 7u, 50u}) {
      const std::vector<Part> parts = parts_in_space(chain, ranks, blocks);
      for (unsigned r = 0; r < ranks; ++r) {
        EXPECT_EQ(parts[r].spheres, at_once[r].spheres)
            << blocks << " blocks at once, rank " << r << " of " << ranks;
        EXPECT_EQ(parts[r].arcs, at_once[r].arcs)
            << blocks << " blocks at once, rank " << r << " of " << ranks;
      }
    }
  }
}

/// So many blocks at a time, and no more.
TEST(PartInSpace, GoesInAsManyRoundsAsAreAskedFor) {
  const Chain chain = chain_of("yarn:n=4000");
  const auto messages = [&](std::uint32_t blocks_at_once) {
    std::uint64_t of_rank_0 = 0;
    run_in_threads(2, [&](Communicator& c) {
      part_in_space(c, even_part_of(chain, 2, c.rank()), blocks_at_once);
      if (c.rank() == 0) of_rank_0 = c.traffic().messages;
    });
    return of_rank_0;
  };
  EXPECT_GT(messages(8), messages(0) + 5);
}

/// By the definition: how many ranks a block may touch beside its own.
TEST(TouchingShare, IsOneForEachOtherRankThatABlockMeets) {
  const auto shares = [](const Chain& chain, unsigned ranks) {
    std::vector<double> all(ranks);
    run_in_threads(ranks, [&](Communicator& c) {
      all[c.rank()] = touching_share(c, even_part_of(chain, ranks, c.rank()));
    });
    return all;
  };
  const auto apart = [](float step) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 600; ++i) spheres.push_back({step * static_cast<float>(i), 0, 0, 1});
    return Chain(std::move(spheres));
  };
  // Of a sample, too: the second half of a chain goes back over the first.
  std::vector<Sphere> there;
  for (int i = 0; i < 80000; ++i) there.push_back({3.0f * static_cast<float>(i), 0, 0, 1});
  there.insert(there.end(), there.rbegin(), there.rend());
  for (const double share : shares(Chain(std::move(there)), 2)) EXPECT_NEAR(share, 1, 0.01);
  for (const unsigned ranks : {1u, 2u, 3u, 5u}) {
    EXPECT_EQ(shares(apart(0), ranks), std::vector<double>(ranks, ranks - 1.0)) << "all in one place";
    EXPECT_EQ(shares(apart(3), ranks), std::vector<double>(ranks, 0)) << "none touches another";
  }
}

}  // namespace
}  // namespace catena::ranks
