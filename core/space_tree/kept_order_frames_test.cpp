#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/space_tree/kept_order.h"
#include "catena/core/sphere_tree/test_search.h"
#include "catena/properties/generators/dice.h"

namespace catena {
namespace {

/// Frames, each made of the last.
using Move = Sphere (*)(const Sphere&, properties::Dice&);

struct Told {
  std::uint32_t kept = 0;  ///< frames that another order than their own served
  double most_work = 0;    ///< in a frame, of that in its own order
};

double work_of(const Chain& chain, const SphereTree& tree, std::vector<Pair>& pairs) {
  SphereQueues queues;
  pairs = pairs_of(chain, tree, queues);
  return static_cast<double>(4 * queues.nodes_done + queues.tests_done);
}

Told frames(Move move, std::uint32_t count = 40) {
  properties::Dice dice(5);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 4200; ++k)  // three levels of nodes
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
    const double work = work_of(chain, kept, pairs), least = work_of(chain, fresh, right);
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
