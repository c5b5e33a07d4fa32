#include "catena/core/parts/halos.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "catena/properties/generators/dice.h"

namespace catena::parts {
namespace {

using properties::Dice;

/// A row of boxes that goes to and fro, so that many meet boxes far from them in the row.
std::vector<Box> any_row(std::uint32_t n, Dice& dice) {
  std::vector<Box> boxes;
  Sphere at{0, 0, 0, 1};
  for (std::uint32_t k = 0; k < n; ++k) {
    at.x += 1.5f * dice.symmetric(), at.y += 1.5f * dice.symmetric(), at.z += 1.5f * dice.symmetric();
    boxes.push_back(Box::around({at.x, at.y, at.z, dice.one_in(50) ? 6 * dice.unit() : dice.unit()}));
  }
  return boxes;
}

/// What meets what by its definition, of any number of boxes in parts of any length, by one and several
/// threads.
TEST(Halos, AreTheBoxesOfOtherPartsThatMeetOnesOwn) {
  std::size_t met = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Dice dice(seed);
    const std::uint32_t n = 1 + dice.below(dice.one_in(2) ? 400 : 70);
    const std::vector<Box> boxes = any_row(n, dice);
    std::set<std::uint32_t> cuts{0, n};
    for (std::uint32_t k = dice.below(12); k > 0; --k) cuts.insert(dice.below(n + 1));
    const std::vector<std::uint32_t> first(cuts.begin(), cuts.end());
    const auto part_of = [&](std::uint32_t box) {
      return std::ranges::upper_bound(first, box) - first.begin() - 1;
    };
    std::vector<std::set<std::uint32_t>> halos(first.size() - 1);
    std::set<std::pair<std::uint32_t, std::ptrdiff_t>> meetings;  // of a box and another part
    for (std::uint32_t a = 0; a < n; ++a)
      for (std::uint32_t b = 0; b < n; ++b)
        if (part_of(a) != part_of(b) && boxes[a].meets(boxes[b])) {
          halos[static_cast<std::size_t>(part_of(a))].insert(b);
          meetings.insert({a, part_of(b)});
        }
    for (const char* threads : {"threads=1", "threads=3"}) {
      const Team team(Parameters("test", {Team::threads_parameter()}, threads));
      const Halos found(boxes, first, team);
      const auto lists = found.find();
      ASSERT_EQ(lists.size(), halos.size());
      for (std::size_t p = 0; p < halos.size(); ++p)
        EXPECT_EQ(lists[p], std::vector<std::uint32_t>(halos[p].begin(), halos[p].end()))
            << seed << ", part " << p;
      // Below 512 boxes each is asked.
      EXPECT_DOUBLE_EQ(found.halo_share(), static_cast<double>(meetings.size()) / n) << seed;
    }
    met += meetings.size();
  }
  EXPECT_GT(met, 1000u);
}

}  // namespace
}  // namespace catena::parts
