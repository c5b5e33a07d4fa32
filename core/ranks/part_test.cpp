#include "catena/core/ranks/part.h"

#include <gtest/gtest.h>

#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/family.h"

namespace catena::ranks {
namespace {

/// Loops of different lengths, an open strand and an empty one between them.
Chain loops() {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 20; ++i)
    spheres.push_back({static_cast<float>(i * i), static_cast<float>(i % 3), 0, 1});
  Exclusion exclusion = Exclusion::arc(1.5);
  exclusion.extra_pairs = {{0, 19}, {3, 8}};
  return Chain(std::move(spheres), Strands{{0, 6, 9, 9, 20}, {1, 0, 0, 1}}, exclusion);
}

/// A part tells of its strands, arcs and joints what the chain does, wherever it is cut.
TEST(Part, TellsWhatTheChainDoes) {
  std::vector<Chain> chains{loops()};
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    properties::Dice dice(seed);
    chains.push_back(generate(properties::FamilyRegistry::instance().family("rules"), dice, 40));
  }
  for (const Chain& chain : chains)
    for (unsigned rank = 0; rank < 3; ++rank) {
      const auto at = [&](unsigned r) { return static_cast<std::uint32_t>(even_start(chain.size(), 3, r)); };
      const Part part = part_of(chain, at(rank), at(rank + 1));
      const Exclusion& rule = chain.exclusion();
      const bool arcs = rule.rule == Exclusion::Rule::arc_window;
      const auto& [first, closed] = chain.strands();
      std::uint32_t next = at(rank);
      for (const Piece& piece : part.pieces) {
        const std::size_t s = piece.strand.number;
        EXPECT_EQ(piece.first, next);
        EXPECT_EQ(piece.begin, next - at(rank));
        next += piece.size;
        ASSERT_LT(s, chain.strand_count());
        EXPECT_EQ(piece.strand.first, first.empty() ? 0 : first[s]);
        EXPECT_EQ(piece.strand.size, first.empty() ? chain.size() : first[s + 1] - first[s]);
        EXPECT_GE(piece.first, piece.strand.first);
        EXPECT_LE(next, piece.strand.first + piece.strand.size);
        const bool loop = !closed.empty() && closed[s] != 0;
        EXPECT_EQ(piece.strand.closed, loop);
        EXPECT_EQ(piece.strand.loop_length, arcs && loop ? chain.view().exclusion.loop_length[s] : 0);
      }
      EXPECT_EQ(next, at(rank + 1));
      std::vector<IdPair> extra;
      for (const Pair& p : rule.extra_pairs)
        for (const auto& [i, j] : {Pair{p.i, p.j}, Pair{p.j, p.i}})
          if (at(rank) <= i && i < next) extra.push_back({i, j});
      std::ranges::sort(extra);
      extra.erase(std::unique(extra.begin(), extra.end()), extra.end());
      EXPECT_EQ(part.extra, extra);
      ASSERT_EQ(part.arcs.size(), arcs ? part.spheres.size() : 0);
      for (std::uint32_t k = 0; k < part.arcs.size(); ++k)
        EXPECT_EQ(part.arcs[k], chain.view().exclusion.arc[at(rank) + k]);
    }
}

}  // namespace
}  // namespace catena::ranks
