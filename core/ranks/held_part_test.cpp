#include "catena/core/ranks/held_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "catena/bench/ranks/lattice_part.h"
#include "catena/core/arithmetic/robust.h"
#include "catena/core/ranks/local_search.h"
#include "catena/core/strategy/registry.h"

namespace catena::ranks {
namespace {

using Dice = std::mt19937;

/// A walk so short of room that everything is near everything.
std::vector<Sphere> crowd(std::uint32_t n, Dice& dice) {
  std::uniform_real_distribution<float> side(0, 3);
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({side(dice), side(dice), side(dice), 0.5f});
  return spheres;
}

/// Some stretches of a chain of strands, as a rank may have got them.
Part stretches(Exclusion rule, bool closed, Dice& dice) {
  Part part;
  part.rule = {rule.rule, rule.window, rule.factor};
  SphereId first = 0;
  for (std::uint64_t strand = 0; strand < 3; ++strand) {
    const Strand whole{first, 40, 0, closed, strand};
    for (SphereId at = first + dice() % 3; at < first + whole.size;) {
      const SphereId end = std::min<SphereId>(first + whole.size, at + 1 + dice() % 9);
      part.pieces.push_back(
          {at, static_cast<std::uint32_t>(part.spheres.size()), static_cast<std::uint32_t>(end - at), whole});
      for (const Sphere& s : crowd(static_cast<std::uint32_t>(end - at), dice)) part.spheres.push_back(s);
      at = end + 1 + dice() % 4;
    }
    first += whole.size;
  }
  return part;
}

std::vector<IdPair> all_pairs(const HeldPart& part) {
  std::vector<IdPair> pairs;
  for (std::uint32_t j = 0; j < part.chain().size(); ++j)
    for (std::uint32_t i = 0; i < j; ++i)
      if (Robust::overlap(part.chain()[i], part.chain()[j]) && !part.neighbours(part.place(i), part.place(j)))
        pairs.push_back({part.id(i), part.id(j)});
  std::ranges::sort(pairs);
  return pairs;
}

struct FoundInPart {
  std::vector<std::uint32_t> count;
  std::vector<IdPair> pairs;
};
FoundInPart found_in(const HeldPart& part, Variant& variant) {
  variant.build(part.chain());
  KeptPairs kept(1 << 20);
  FoundInPart found{search_within(part, variant, Request::Want::pairs, 1 << 20, kept), {}};
  for (const auto& list : kept.take()) found.pairs.insert(found.pairs.end(), list.begin(), list.end());
  std::ranges::sort(found.pairs);
  return found;
}

/// Pieces of open strands are searched as one strand, where the window is not long beside them; what that
/// passes over, where pieces part, is found all the same, and no neighbour is.
TEST(HeldPart, FindsWhatCollidesInPiecesOfStrands) {
  Dice dice(7);
  std::uint64_t passed = 0, as_one = 0, otherwise = 0;
  for (int round = 0; round < 60; ++round)
    for (const std::uint32_t window : {1u, 2u, 3u, 12u})
      for (const bool closed : {false, true}) {
        const HeldPart part(stretches(Exclusion::index(window), closed, dice));
        const bool one = part.chain().strand_count() == 1;
        (one ? as_one : otherwise) += 1;
        part.for_each_passed([&](std::uint32_t i, std::uint32_t j) {
          EXPECT_TRUE(part.chain().neighbours(i, j));
          passed += Robust::overlap(part.chain()[i], part.chain()[j]);
        });
        const auto variant = StrategyRegistry::instance().make("Hybrid");
        const auto [count, found] = found_in(part, *variant);
        const std::vector<IdPair> exact = all_pairs(part);
        EXPECT_EQ(found, exact) << window << ' ' << closed;
        std::vector<std::uint32_t> expected(part.chain().size(), 0);
        for (std::uint32_t i = 0; i < part.chain().size(); ++i)
          for (const auto& [a, b] : exact) expected[i] += a == part.id(i) || b == part.id(i);
        EXPECT_EQ(count, expected);
        KeptPairs any(0);
        search_within(part, *variant, Request::Want::any, 0, any);
        EXPECT_EQ(any.found() > 0, !exact.empty());
      }
  EXPECT_GT(passed, 100u);
  EXPECT_GT(as_one, 50u);
  EXPECT_GT(otherwise, 50u);
}

/// A closed strand of which a rank has all but a few spheres, at whichever end, be it one: it is open there.
TEST(HeldPart, ClosesOnlyStrandsOfWhichItHasAll) {
  const auto variant = StrategyRegistry::instance().make("Hybrid");
  for (std::uint32_t whole = 3; whole <= 10; ++whole)
    for (std::uint32_t first = 0; first < whole; ++first)
      for (std::uint32_t size = 1; size <= whole - first; ++size)
        for (const std::uint32_t window : {1u, 2u, 3u}) {
          Part part;
          part.rule = {Exclusion::Rule::index_window, window, 0};
          part.pieces = {{first, 0, size, Strand{0, whole, 0, 1, 0}},
                         {whole, size, 2, Strand{whole, 2, 0, 0, 1}}};
          part.spheres.assign(size + 2, {0, 0, 0, 1});  // all that are no neighbours collide
          const HeldPart held(std::move(part));
          EXPECT_EQ(found_in(held, *variant).pairs, all_pairs(held))
              << size << " from " << first << " of " << whole << ", window " << window;
        }
}

/// A pair that only a passed one makes: whether something collides is still told.
TEST(HeldPart, TellsOfAPairWherePiecesPart) {
  Part part;
  const Strand strand{0, 100, 0, 0, 0};
  part.pieces = {{0, 0, 4, strand}, {50, 4, 4, strand}};
  for (int k = 0; k < 8; ++k) part.spheres.push_back({k < 4 ? 3.0f * k : 3.0f * (k - 1), 0, 0, 1});
  const HeldPart held(std::move(part));  // spheres 3 and 50 coincide, all others are apart
  ASSERT_EQ(held.chain().strand_count(), 1u);
  const auto variant = StrategyRegistry::instance().make("Hybrid");
  for (const Request::Want want : {Request::Want::any, Request::Want::counts, Request::Want::pairs}) {
    variant->build(held.chain());
    KeptPairs kept(10);
    search_within(held, *variant, want, 10, kept);
    EXPECT_EQ(kept.found(), 1u);
  }
}

/// Numbers past 2^32, as no chain of one process has them: three parts in the middle of a chain of 5e9
/// spheres.
TEST(HeldPart, NumbersSpheresIn64Bits) {
  const bench::LatticeBox box{.side = 1700, .reach = 1, .rods = true};
  const SphereId first = (SphereId{1} << 32) - 500;
  const HeldPart held(lattice_part(box, first, first + 1000));
  const Place below = held.place(499), above = held.place(500);
  EXPECT_EQ(below.id, (SphereId{1} << 32) - 1);
  EXPECT_EQ(above.id, SphereId{1} << 32);
  for (std::uint32_t i = 1; i < 1000; ++i) {
    const Place a = held.place(i - 1), b = held.place(i), first_of_all = held.place(0);
    EXPECT_EQ(held.neighbours(a, b), box.neighbours(a.id, b.id)) << i;
    if (i > 1) {
      EXPECT_FALSE(held.neighbours(first_of_all, b)) << i;
    }
  }
}

}  // namespace
}  // namespace catena::ranks
