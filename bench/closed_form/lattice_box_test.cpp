#include "catena/bench/closed_form/lattice_box.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/property.h"

namespace catena::bench {
namespace {

using properties::Dice;
using properties::Subject;

Chain chain_of(const LatticeBox& box) { return open_input(box.scene()).animation->frame(0); }

std::vector<LatticeBox> small_boxes() {
  std::vector<LatticeBox> boxes;
  for (const std::uint32_t side : {1u, 2u, 3u, 5u, 7u})
    for (const std::uint32_t reach : {0u, 1u, 2u, 3u, 6u})
      for (const bool face_centred : {false, true})
        for (const bool rods : {false, true}) boxes.push_back({side, reach, face_centred, rods});
  return boxes;
}

/// The chain turned and mirrored by one of the lattice's 48 symmetries, moved by whole steps and scaled by a
/// power of two, so that no number is rounded.
Chain moved_exactly(const Chain& chain, Dice& dice) {
  std::array<int, 3> axes{0, 1, 2};
  for (int k = 2; k > 0; --k)
    std::swap(axes[static_cast<std::size_t>(k)], axes[dice.below(static_cast<std::uint32_t>(k) + 1)]);
  const std::array<float, 3> sign{dice.pick({1.0f, -1.0f}), dice.pick({1.0f, -1.0f}),
                                  dice.pick({1.0f, -1.0f})};
  const float far = dice.pick({0.0f, 0x1p10f, 0x1p20f, 0x1p23f});
  const std::array<float, 3> shift{dice.pick({far, -far}), dice.pick({far, 0.0f}), dice.pick({-far, 0.0f})};
  const int exponent = dice.pick({0, 0, 1, -30, 31, -120, 90});
  std::vector<Sphere> spheres;
  for (const Sphere& s : chain.spheres()) {
    const std::array<float, 3> old{s.x, s.y, s.z};
    const auto place = [&](std::size_t k) {
      return std::ldexp(sign[k] * old[static_cast<std::size_t>(axes[k])] + shift[k], exponent);
    };
    spheres.push_back({place(0), place(1), place(2), std::ldexp(s.radius, exponent)});
  }
  return chain.moved(std::move(spheres));
}

std::string fault_of(Variant& variant, const LatticeBox& box, const Chain& chain) {
  Collisions found;
  variant.build(chain);
  variant.find(chain, {}, found);
  return fault(box, found, true);
}

TEST(LatticeBox, FormulaIsTheNumberOfPairsOfPoints) {
  for (const LatticeBox& box : small_boxes()) {
    std::uint64_t pairs = 0, ties = 0;
    for (std::uint32_t i = 0; i < box.spheres(); ++i)
      for (std::uint32_t j = i + 1; j < box.spheres(); ++j) {
        const auto p = box.cell(i), q = box.cell(j);
        pairs += box.collide(i, j);
        ties += box.collide(i, j) &&
                box.square_of({p[0] - q[0], p[1] - q[1], p[2] - q[2]}) == std::int64_t{box.reach} * box.reach;
      }
    EXPECT_EQ(box.pairs(), pairs) << box.scene();
    EXPECT_EQ(box.ties(), ties) << box.scene();
  }
}

TEST(LatticeBox, HasItsChainInTheScene) {
  for (const LatticeBox& box : small_boxes()) {
    const Chain chain = chain_of(box);
    ASSERT_EQ(chain.size(), box.spheres());
    for (std::uint32_t i = 0; i < chain.size(); ++i)
      for (std::uint32_t j = i + 1; j < std::min(chain.size(), i + 40); ++j) {
        const auto p = box.cell(i), q = box.cell(j);
        const double square = std::pow(chain[i].x - chain[j].x, 2) + std::pow(chain[i].y - chain[j].y, 2) +
                              std::pow(chain[i].z - chain[j].z, 2);
        ASSERT_EQ(square, box.square_of({p[0] - q[0], p[1] - q[1], p[2] - q[2]})) << box.scene();
        ASSERT_EQ(chain.neighbours(i, j), box.neighbours(i, j)) << box.scene();
      }
  }
}

TEST(LatticeBox, TouchesInAsManyDirectionsAsTheSquareIsASumOfThree) {
  // Steps of exactly 15 on the cubic lattice: 150, the number of ways to write 225 as a sum of three squares.
  const LatticeBox one{.side = 40, .reach = 15}, less{.side = 40, .reach = 14};
  std::uint64_t directions = 0;
  for (int a = -15; a <= 15; ++a)
    for (int b = -15; b <= 15; ++b)
      for (int c = -15; c <= 15; ++c) directions += a * a + b * b + c * c == 225;
  EXPECT_EQ(directions, 150u);
  EXPECT_GT(one.ties(), 0u);
  EXPECT_LT(one.ties(), one.pairs() - less.pairs());
  EXPECT_EQ((LatticeBox{.side = 5, .reach = 1, .rods = true}.ties()), 2u * 5 * 5 * 4);
  EXPECT_EQ((LatticeBox{.side = 5, .reach = 1}.pairs()), 3u * 5 * 5 * 4 - 124);
}

TEST(LatticeBox, EveryExactVariantFindsTheClosedForm) {
  Dice dice(17);
  for (const Subject& subject : Subject::available()) {
    if (!subject.exact()) continue;
    const auto variant = subject.make();
    for (int k = 0; k < 12; ++k) {
      const LatticeBox box{1 + dice.below(subject.info.all_pairs ? 7 : 10), dice.below(6), dice.one_in(2),
                           dice.one_in(3)};
      const Chain chain = moved_exactly(chain_of(box), dice);
      try {
        EXPECT_EQ(fault_of(*variant, box, chain), "") << subject.info.name << " on " << box.scene();
      } catch (const CapacityError&) {  // a declared limit
      }
    }
  }
}

/// The same for counts alone, which need no memory for the pairs.
std::string fault_of_counts(const LatticeBox& box) {
  const auto variant = StrategyRegistry::instance().make("Hybrid");
  const Request counts{.want = Request::Want::counts};
  const Chain chain = chain_of(box);
  Collisions found;
  variant->prepare(counts);
  variant->build(chain);
  variant->find(chain, counts, found);
  return fault(box, found, false);
}

TEST(LatticeBox, HybridFindsTheClosedFormOfAMillionSpheres) {
  const LatticeBox box{.side = 100, .reach = 1};  // two million pairs, all of them ties
  EXPECT_EQ(fault_of(*StrategyRegistry::instance().make("Hybrid"), box, chain_of(box)), "");
}

TEST(LatticeBoxLong, HybridFindsTheClosedFormOfMillionsOfTies) {
  for (const LatticeBox& box : {LatticeBox{100, 3}, LatticeBox{100, 5, false, true},
                                LatticeBox{100, 6, true, false}, LatticeBox{40, 15}})
    EXPECT_EQ(fault_of_counts(box), "") << box.scene();
}

TEST(LatticeBox, NamesWhatIsWrong) {
  const LatticeBox box{.side = 4, .reach = 2};
  const Chain chain = chain_of(box);
  const auto variant = StrategyRegistry::instance().make("CPU1");
  Collisions right;
  variant->build(chain);
  variant->find(chain, {}, right);
  EXPECT_EQ(fault(box, right, true), "");
  Collisions wrong = right;
  wrong.pairs.back() = wrong.pairs.front();
  EXPECT_EQ(fault(box, wrong, true), "a pair is there twice");
  wrong = right;
  const Pair last = right.pairs.back();
  wrong.pairs.back() = {last.j, last.i};
  EXPECT_EQ(fault(box, wrong, true), fmt::format("{} and {} do not collide", last.j, last.i));
  wrong = right;
  wrong.pairs.back() = {0, 63};
  EXPECT_EQ(fault(box, wrong, true), "0 and 63 do not collide") << "far apart";
  wrong = right;
  wrong.pairs.pop_back();
  EXPECT_EQ(fault(box, wrong, true), fmt::format("{} pairs are kept of {}", box.pairs() - 1, box.pairs()));
  wrong = right;
  ++wrong.count[3];
  const std::uint64_t ends = 2 * box.pairs();
  EXPECT_EQ(fault(box, wrong, false), fmt::format("counts sum up to {} instead of {}", ends + 1, ends));
  wrong = right;
  --wrong.pair_count;
  EXPECT_EQ(fault(box, wrong, false), fmt::format("{} pairs instead of {}", box.pairs() - 1, box.pairs()));
  const LatticeBox wide{.side = 5, .reach = 2};
  const Chain longer = chain_of(wide);
  variant->build(longer);
  variant->find(longer, {}, wrong);
  EXPECT_EQ(fault(wide, wrong, false), "");
  ++*std::ranges::max_element(wrong.count), --wrong.count.front();
  const std::uint64_t most = wide.most_collisions();
  EXPECT_EQ(fault(wide, wrong, false),
            fmt::format("a sphere has {} collisions; the most is {}", most + 1, most))
      << "as many ends, elsewhere";
}

TEST(LatticeBox, HasNeighboursOnBothSides) {
  const LatticeBox rods{.side = 4, .reach = 2, .rods = true}, one{.side = 4, .reach = 2};
  for (std::uint64_t i = 0; i < 64; ++i)
    for (std::uint64_t j = 0; j < 64; ++j) {
      const bool next = i + 1 == j || j + 1 == i;
      EXPECT_EQ(one.neighbours(i, j), next) << i << ' ' << j;
      EXPECT_EQ(rods.neighbours(i, j), next && i / 4 == j / 4) << i << ' ' << j;
    }
}

}  // namespace
}  // namespace catena::bench
