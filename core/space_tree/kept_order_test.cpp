#include "catena/core/space_tree/kept_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

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
    kept.sorted(500, row(count, 0.5f));
    EXPECT_FALSE(kept.serves(row(count, 1))) << count << " that were smaller when they were sorted last";
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
  // Nor squares along one axis.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto squares = [&](float apart) {
      Boxes boxes(count);
      for (std::uint32_t k = 0; k < count; ++k) {
        std::array<float, 3> low{}, high{1, 1, 1};
        low[axis] = apart * static_cast<float>(k), high[axis] += low[axis], high[(axis + 1) % 3] = 0;
        boxes.set(k, low, high);
      }
      return boxes;
    };
    KeptOrder of_squares = sorted(squares(2));
    EXPECT_TRUE(of_squares.serves(squares(2))) << axis;
    EXPECT_FALSE(of_squares.serves(squares(1))) << axis;
  }
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

/// What is long along one axis grows by much where it grows across by half.
TEST(KeptOrder, TellsEachAxisByItsOwnWidth) {
  for (std::size_t along = 0; along < 3; ++along) {
    const auto needles = [&](float width) {
      Boxes boxes(20);
      for (std::uint32_t k = 0; k < 20; ++k) {
        std::array<float, 3> low{}, high{width, width, width};
        for (std::size_t d = 0; d < 3; ++d) low[d] = static_cast<float>(3 * k), high[d] += low[d];
        high[along] = low[along] + 30;
        boxes.set(k, low, high);
      }
      return boxes;
    };
    EXPECT_FALSE(sorted(needles(1)).serves(needles(1.5f))) << along;
  }
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
  std::uint32_t tries = 0, waited = 0, wait = 0;
  for (std::uint32_t frame = 0; frame < 1000; ++frame) {
    if (!kept.may_serve(500)) {
      ++waited;
    } else {
      ++tries;
      EXPECT_EQ(waited, wait) << "twice as long each time, and one, and at last as long as five times";
      wait = std::min(2 * wait + 1, 31u), waited = 0;
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

}  // namespace
}  // namespace catena
