// Parts of a chain that each rank makes for itself, and the closed form that judges what is found of them.
#include "catena/bench/ranks/lattice_part.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "catena/core/ranks/test_chain.h"
#include "catena/core/ranks/thread_ranks.h"

namespace catena::ranks {
namespace {

TEST(LatticePart, IsAPartOfTheScene) {
  for (const bench::LatticeBox& box : {bench::LatticeBox{7, 3}, bench::LatticeBox{6, 2, true, false},
                                       bench::LatticeBox{5, 1, false, true}}) {
    const Chain chain = chain_of(box.scene());
    for (const std::uint32_t begin : {0u, 13u, 60u}) {
      const Part made = lattice_part(box, begin, chain.size()), cut = part_of(chain, begin, chain.size());
      EXPECT_EQ(made.spheres, cut.spheres) << box.scene();
      ASSERT_EQ(made.pieces.size(), cut.pieces.size());
      for (std::size_t k = 0; k < made.pieces.size(); ++k)
        EXPECT_EQ(std::memcmp(&made.pieces[k], &cut.pieces[k], sizeof(Piece)), 0) << box.scene() << ' ' << k;
    }
  }
}

TEST(LatticePart, GivesTheClosedFormOnAnyRanks) {
  for (const bench::LatticeBox& box :
       {bench::LatticeBox{12, 3}, bench::LatticeBox{9, 2, true, false}, bench::LatticeBox{9, 1, false, true}})
    run_in_threads(5, [&](Communicator& c) {
      RankWork work;
      RankAnswer answer = search(c,
                                 lattice_part(box, even_start(box.spheres(), 5, c.rank()),
                                              even_start(box.spheres(), 5, c.rank() + 1)),
                                 {.order = Order::space}, work);
      EXPECT_EQ(lattice_fault(c, box, answer, true), "");
      if (!answer.pairs.empty()) answer.pairs[0].j = answer.pairs[0].i;
      const std::string fault = lattice_fault(c, box, answer, true);
      if (!answer.pairs.empty()) {
        EXPECT_NE(fault, "");
      }
    });
}

/// On whichever rank; each says what is wrong of all, or of its own pairs.
TEST(LatticePart, NamesWhatIsWrongOfTheAnswer) {
  const bench::LatticeBox box{6, 2};
  run_in_threads(3, [&](Communicator& c) {
    const auto start = [&](unsigned rank) { return even_start(box.spheres(), 3, rank); };
    RankWork work;
    const RankAnswer right = search(c, lattice_part(box, start(c.rank()), start(c.rank() + 1)), {}, work);
    const auto fault = [&](unsigned of, const auto& spoil, bool with_pairs = true) {
      RankAnswer wrong = right;
      if (c.rank() == of) spoil(wrong);
      return lattice_fault(c, box, wrong, with_pairs);
    };
    const std::uint64_t n = box.pairs();
    for (unsigned of = 0; of < 3; ++of) {
      EXPECT_EQ(fault(of, [](RankAnswer& a) { ++a.count.back(); }),
                fmt::format("counts sum up to {} instead of {}", 2 * n + 1, 2 * n));
      EXPECT_EQ(fault(of, [](RankAnswer& a) { a.pairs.pop_back(); }),
                fmt::format("{} pairs are kept of {}", n - 1, n));
      EXPECT_EQ(fault(
                    of, [](RankAnswer& a) { a.pairs.pop_back(); }, false),
                "");
      const auto on_it = [&](const std::string& words) { return c.rank() == of ? words : ""; };
      EXPECT_EQ(fault(of, [](RankAnswer& a) { a.pairs[1] = a.pairs[0]; }), on_it("a pair is there twice"));
      const SphereId i = right.pairs[0].i, apart = i < box.spheres() / 2 ? box.spheres() - 1 : i + 1;
      EXPECT_EQ(fault(of, [&](RankAnswer& a) { a.pairs[0].j = apart; }),
                on_it(fmt::format("{} and {} do not collide", i, apart)));
    }
    RankAnswer more = right;
    ++more.pair_count;
    EXPECT_EQ(lattice_fault(c, box, more, true), fmt::format("{} pairs instead of {}", n + 1, n));
  });
}

}  // namespace
}  // namespace catena::ranks
