#include "catena/core/space_tree/kept_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/sphere_tree/sphere_kernels.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/sorted_pairs.h"

namespace catena {
namespace {

/// Boxes in groups of sixteen; what is behind the last holds nothing.
class Boxes {
 public:
  explicit Boxes(std::uint32_t boxes) : boxes_(boxes), fields_(std::size_t{(boxes + 15) / 16} * 96, nan) {}
  Boxes& set(std::uint32_t box, float low, float high) {
    return set(box, {low, low, low}, {high, high, high});
  }
  Boxes& set(std::uint32_t box, const std::array<float, 3>& low, const std::array<float, 3>& high) {
    for (std::uint32_t d = 0; d < 3; ++d) at(box, d) = low[d], at(box, 3 + d) = high[d];
    return *this;
  }
  Boxes& radii(float least, float greatest) {
    least_radius_ = least, greatest_radius_ = greatest;
    return *this;
  }
  operator BoxGroups() const { return {fields_.data(), boxes_, least_radius_, greatest_radius_}; }

 private:
  static constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  float& at(std::uint32_t box, std::uint32_t f) { return fields_[(box / 16 * 6 + f) * 16 + box % 16]; }
  std::uint32_t boxes_;
  std::vector<float> fields_;
  float least_radius_ = 0, greatest_radius_ = 0;
};

/// Cubes in a row, each so wide and so far from the last.
Boxes row(std::uint32_t count, float width, float apart = 2) {
  Boxes boxes(count);
  for (std::uint32_t k = 0; k < count; ++k)
    boxes.set(k, static_cast<float>(k) * apart, static_cast<float>(k) * apart + width);
  return boxes;
}

KeptOrder sorted(const Boxes& boxes, std::uint32_t entries = 500) {
  KeptOrder kept;
  kept.sorted(entries, boxes);
  return kept;
}

TEST(KeptOrder, IsOfAsManyAsWereSorted) {
  KeptOrder none;
  EXPECT_FALSE(none.may_serve(0));
  EXPECT_FALSE(none.may_serve(500));
  KeptOrder kept = sorted(row(33, 1));
  EXPECT_TRUE(kept.may_serve(500));
  EXPECT_FALSE(kept.may_serve(499));
  EXPECT_FALSE(kept.may_serve(501));
  kept.forget();
  EXPECT_FALSE(kept.may_serve(500));
}

TEST(KeptOrder, ServesWhileBoxesTakeUpNoMoreRoom) {
  for (const std::uint32_t count : {1u, 15u, 16u, 17u, 33u}) {
    KeptOrder kept = sorted(row(count, 1));
    EXPECT_TRUE(kept.serves(row(count, 1))) << count;
    EXPECT_TRUE(kept.serves(row(count, 1.02f, 2.02f))) << count;
    EXPECT_TRUE(kept.serves(row(count, 0.98f, 1.98f))) << count;
    EXPECT_FALSE(kept.serves(row(count, 1.2f))) << count << " that grow";
  }
}

TEST(KeptOrder, DoesNotServeWhereASixteenthIsSpreadOverAll) {
  const std::uint32_t count = 160;
  KeptOrder kept = sorted(row(count, 1));
  Boxes some = row(count, 1);
  for (std::uint32_t k = 5; k < count; k += 16) some.set(k, 0, 2 * count);
  EXPECT_FALSE(kept.serves(some));
}

TEST(KeptOrder, DoesNotServeWhatComesTogether) {
  const std::uint32_t count = 64;
  KeptOrder kept = sorted(row(count, 1));
  // As wide as before, in half the room on each axis.
  EXPECT_FALSE(kept.serves(row(count, 1, 1)));
}

TEST(KeptOrder, IsNotMadeToServeByOneThatLeaves) {
  const std::uint32_t count = 64;
  KeptOrder kept = sorted(row(count, 1));
  Boxes apart = row(count, 1.2f);
  apart.set(count - 1, 1e6f, 1e6f + 1);
  EXPECT_FALSE(kept.serves(apart));
}

/// As spheres are of which a list of near pairs is made.
TEST(KeptOrder, ServesSpheresThatAreAllThicker) {
  const auto thick = [](float by) {
    Boxes boxes(40);
    for (std::uint32_t k = 0; k < 40; ++k)
      boxes.set(k, 2 * static_cast<float>(k) - by, 2 * static_cast<float>(k) + 1 + by);
    return boxes.radii(0.25f + by, 0.5f + by);
  };
  for (const float by : {0.1f, 0.5f, 2.0f}) {
    KeptOrder thinner = sorted(thick(0)), thicker = sorted(thick(by));
    EXPECT_TRUE(thinner.serves(thick(by))) << by;
    EXPECT_TRUE(thicker.serves(thick(0))) << by;
    EXPECT_FALSE(sorted(thick(0)).serves(thick(by).radii(0.25f, 0.5f + by))) << by << ", not all";
    EXPECT_FALSE(sorted(thick(0)).serves(thick(by).radii(0.25f + by, 0.5f))) << by << ", not all";
  }
}

TEST(KeptOrder, TellsBoxesInAPlaneFromOneAnother) {
  const std::uint32_t count = 32;
  const auto flat = [&](float width) {
    Boxes boxes(count);
    for (std::uint32_t k = 0; k < count; ++k)
      boxes.set(k, {float(2 * k), 0, 5}, {float(2 * k) + width, width, 5});
    return boxes;
  };
  KeptOrder kept = sorted(flat(1));
  EXPECT_TRUE(kept.serves(flat(1)));
  EXPECT_FALSE(kept.serves(flat(1.5f)));
}

TEST(KeptOrder, ServesPoints) {
  KeptOrder kept = sorted(row(20, 0, 0));
  EXPECT_TRUE(kept.serves(row(20, 0, 0)));
  EXPECT_TRUE(kept.serves(row(20, 0, 1))) << "each node is a point of its own";
  EXPECT_FALSE(kept.serves(row(20, 1, 1)));
}

TEST(KeptOrder, DoesNotServeWhatIsBeyondNumbers) {
  constexpr float greatest = std::numeric_limits<float>::max(),
                  infinity = std::numeric_limits<float>::infinity();
  KeptOrder kept = sorted(row(3, 1));
  EXPECT_FALSE(kept.serves(Boxes(3).set(0, 0, 1).set(1, -infinity, infinity).set(2, 0, 1)));
  KeptOrder large = sorted(Boxes(1).set(0, -greatest, greatest));
  EXPECT_TRUE(large.serves(Boxes(1).set(0, -greatest, greatest)));
}

TEST(KeptOrder, IsSortedAgainAfterSixtyFourFrames) {
  KeptOrder kept = sorted(row(40, 1));
  std::uint32_t frames = 0;
  for (; kept.may_serve(500) && frames < 1000; ++frames) EXPECT_TRUE(kept.serves(row(40, 1)));
  EXPECT_EQ(frames, 64u);
  kept.sorted(500, row(40, 1));
  EXPECT_TRUE(kept.may_serve(500));
}

TEST(KeptOrder, IsTriedLessOftenWhereItDoesNotServe) {
  KeptOrder kept = sorted(row(40, 1));
  std::uint32_t tries = 0;
  for (std::uint32_t frame = 0; frame < 1000; ++frame) {
    if (kept.may_serve(500)) {
      ++tries;
      EXPECT_FALSE(kept.serves(row(40, 3)));
    }
    kept.sorted(500, row(40, 1));
  }
  EXPECT_GT(tries, 1000u / 33);
  EXPECT_LT(tries, 50u);
  while (!kept.may_serve(500)) kept.sorted(500, row(40, 1));
  EXPECT_TRUE(kept.serves(row(40, 1)));
  EXPECT_TRUE(kept.may_serve(500)) << "and at once again where it does";
}

/// Frames, each made of the last.
using Move = Sphere (*)(const Sphere&, properties::Dice&);

struct Told {
  std::uint32_t kept = 0;  ///< frames that another order than their own served
  double most_work = 0;    ///< in a frame, of that in its own order
};

std::uint64_t work_of(const Chain& chain, const SphereTree& tree, std::vector<Pair>& pairs) {
  std::vector<SphereQueues> queues(1);
  Collisions found;
  PairCollector collector(chain.size(), {}, found);
  search_sphere_tree(chain.view(), tree, queues, collector, Team());
  collector.finish();
  properties::sort(found.pairs);
  pairs = found.pairs;
  return 4 * queues[0].nodes_done + queues[0].tests_done;
}

Told frames(Move move, std::uint32_t count = 40) {
  properties::Dice dice(5);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 4000; ++k)
    spheres.push_back({20 * dice.symmetric(), 20 * dice.symmetric(), 20 * dice.symmetric(), 1});
  SphereTree kept, fresh;
  Told told;
  build_sphere_tree(Chain(spheres).view(), kept, {}, Team());
  for (std::uint32_t frame = 0; frame < count; ++frame) {
    for (Sphere& s : spheres) s = move(s, dice);
    const Chain chain(spheres);
    build_sphere_tree(chain.view(), kept, {}, Team(), SpaceSort::where_needed);
    build_sphere_tree(chain.view(), fresh, {}, Team());
    std::vector<Pair> pairs, right;
    const auto work = static_cast<double>(work_of(chain, kept, pairs)),
               least = static_cast<double>(work_of(chain, fresh, right));
    EXPECT_EQ(pairs, right);
    EXPECT_FALSE(right.empty());
    told.kept += !std::ranges::equal(kept.index, fresh.index);
    told.most_work = std::max(told.most_work, work / least);
  }
  return told;
}

TEST(KeptOrder, OfAShakenTubeServesForManyFramesWithoutMuchMoreWork) {
  const Told told = frames([](const Sphere& s, properties::Dice& dice) {
    const auto by = [&] { return 0.02f * dice.symmetric(); };
    return Sphere{s.x + by(), s.y + by(), s.z + by(), s.radius};
  });
  EXPECT_EQ(told.kept, 40u);
  EXPECT_LT(told.most_work, 1.15);
}

TEST(KeptOrder, ServesNothingThatLiesElsewhereInEachFrame) {
  const Told told = frames([](const Sphere& s, properties::Dice& dice) {
    return Sphere{20 * dice.symmetric(), 20 * dice.symmetric(), 20 * dice.symmetric(), s.radius};
  });
  EXPECT_EQ(told.kept, 0u);
}

/// However a tube moves, a kept order takes no more work than its own would, but for a little.
TEST(KeptOrder, NeverTakesMuchMoreWork) {
  const auto most_work = [](Move move) { return frames(move).most_work; };
  constexpr double a_little = 1.25;
  EXPECT_LT(most_work([](const Sphere& s, properties::Dice& dice) {
              return dice.one_in(100) ? Sphere{20 * dice.symmetric(), 20 * dice.symmetric(),
                                               20 * dice.symmetric(), s.radius}
                                      : s;
            }),
            a_little)
      << "one in a hundred jumps";
  EXPECT_LT(most_work([](const Sphere& s, properties::Dice& dice) {
              return dice.one_in(2000) ? Sphere{20 * dice.symmetric(), 20 * dice.symmetric(),
                                                20 * dice.symmetric(), s.radius}
                                       : s;
            }),
            a_little)
      << "one or two jump";
  EXPECT_LT(most_work([](const Sphere& s, properties::Dice& dice) {
              const auto by = [&] { return 0.5f * dice.symmetric(); };
              return Sphere{s.x + by(), s.y + by(), s.z + by(), s.radius};
            }),
            a_little)
      << "all move by half a radius";
  EXPECT_LT(most_work([](const Sphere& s, properties::Dice&) {
              return Sphere{s.x + 0.1f * s.y, s.y, s.z, s.radius};
            }),
            a_little)
      << "shear";
  EXPECT_LT(most_work([](const Sphere& s, properties::Dice&) {
              return Sphere{s.x * std::cos(0.1f) - s.y * std::sin(0.1f),
                            s.x * std::sin(0.1f) + s.y * std::cos(0.1f), s.z, s.radius};
            }),
            a_little)
      << "a turn";
  EXPECT_LT(most_work([](const Sphere& s, properties::Dice& dice) {
              const auto by = [&] { return 0.3f * dice.symmetric(); };
              return Sphere{0.97f * s.x + by(), 0.97f * s.y + by(), 0.97f * s.z + by(), s.radius};
            }),
            a_little)
      << "what comes together and is shaken";
  EXPECT_LT(most_work([](const Sphere& s, properties::Dice&) {
              return Sphere{-s.y, s.z, s.x, s.radius};
            }),
            a_little)
      << "axes change places";
}

}  // namespace
}  // namespace catena
