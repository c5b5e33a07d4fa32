#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "catena/reference/bounds.h"
#include "catena/reference/testing/bodies.h"

namespace catena::reference {
namespace {

using testing::Body, testing::Kind, testing::Shown;
using testing::infinity;

RC_GTEST_PROP(BoundsEnclose, WhatIsInIsContainedAndNotSeparate, ()) {
  Body outer = testing::any_body(testing::any_kind()), inner = testing::any_body(testing::any_kind());
  inner.centre = outer.centre;
  if (is_round(outer)) outer.radius = *rc::gen::inRange(0, 60);
  if (is_round(inner)) inner.radius = *rc::gen::inRange(0, 4);
  const double scale = std::ldexp(1.0, *rc::gen::inRange(-900, 900));
  const Shown o(outer, scale), i(inner, scale);
  const bool in = encloses(o, i);
  RC_TAG(in ? "encloses" : "does not");
  RC_ASSERT(encloses(Everything{}, i));
  bool corners = true;  // and balls round them
  for (int corner = 0; corner < 81; ++corner) {
    const Vector64 c =
        inner.some_point({corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 % 3 - 1, corner / 27 - 1})
            .scaled(scale);
    corners = corners && contains(o, Sphere64{c.x, c.y, c.z, inner.radius * scale});
  }
  if (inner.kind == Kind::slabs) {
    RC_ASSERT(!in || corners);
  } else {
    RC_ASSERT(in == corners);
  }
}

TEST(BoundsEnclose, EachKindInEachOther) {
  const std::vector<Slab> cube{{{1, 0, 0}, -4, 4}, {{0, 1, 0}, -4, 4}, {{0, 0, 1}, -4, 4}};
  const std::vector<AnyBound> outer{Sphere64{0, 0, 0, 7}, Capsule64{{0, 0, 0}, {4, 0, 0}, 7},
                                    Box64{{-4, -4, -4}, {4, 4, 4}}, Slabs64{{0, 0, 0}, cube}, Everything{}};
  const std::vector<AnyBound> in{Sphere64{0, 0, 0, 4}, Capsule64{{0, 0, -2}, {0, 0, 2}, 2},
                                 Box64{{-4, -4, -4}, {4, 4, 4}}},
      out{Sphere64{8, 0, 0, 4}, Capsule64{{0, 0, 0}, {0, 0, 2}, 7}, Box64{{-4, -4, -8}, {4, 4, 4}},
          Box64{{-4, -4, -4}, {4, 4, 8}}};
  for (const AnyBound& o : outer) {
    const bool everything = std::holds_alternative<Everything>(o);
    for (const AnyBound& i : in) EXPECT_TRUE(encloses(o, i)) << o.index() << i.index();
    for (const AnyBound& i : out) EXPECT_EQ(encloses(o, i), everything) << o.index() << i.index();
    EXPECT_EQ(encloses(o, Everything{}), everything);
    EXPECT_EQ(encloses(o, Sphere64{0, 0, 0, infinity}), everything);
  }
}

/// A box of which one corner is out, and it alone, whichever it is.
TEST(BoundsEnclose, EachCornerOfABox) {
  for (int corner = 0; corner < 8; ++corner) {
    const auto ends = [&](int axis) {
      return corner >> axis & 1 ? std::pair(-1.0, 4.5) : std::pair(-4.5, 1.0);
    };
    const auto [x, y, z] = std::array{ends(0), ends(1), ends(2)};
    const Box64 box{{x.first, y.first, z.first}, {x.second, y.second, z.second}};
    EXPECT_FALSE(encloses(Sphere64{0, 0, 0, 7}, box)) << corner;
    EXPECT_TRUE(encloses(Sphere64{0, 0, 0, 8}, box)) << corner;
  }
}

TEST(BoundsEnclose, SlabsInSlabs) {
  const std::vector<Slab> three{{{1, 0, 0}, -4, 4}, {{0, 1, 0}, -4, 4}, {{1, 1, 0}, -4, 4}};
  std::vector<Slab> fewer{three[2], three[0]}, smaller = three;
  smaller[1].high = 3;
  const Slabs64 bound{{1, 2, 3}, three};
  EXPECT_TRUE(encloses(bound, bound));
  EXPECT_TRUE(encloses(bound, Slabs64{{1, 2, 3}, smaller}));
  EXPECT_FALSE(encloses(Slabs64{{1, 2, 3}, smaller}, bound));
  EXPECT_TRUE(encloses(Slabs64{{1, 2, 3}, fewer}, bound));
  EXPECT_FALSE(encloses(bound, Slabs64{{1, 2, 3}, fewer}));
  EXPECT_FALSE(encloses(bound, Slabs64{{1, 2, 4}, three}));
}

TEST(BoundsEnclose, BoxesWithInfiniteEnds) {
  const Box64 up{{0, 0, 0}, {1, 1, infinity}}, higher{{0, 0, 1}, {1, 1, infinity}};
  const Slab z{{0, 0, 1}, 0, infinity};
  EXPECT_TRUE(encloses(up, higher));
  EXPECT_FALSE(encloses(higher, up));
  EXPECT_FALSE(encloses(Sphere64{0, 0, 0, 9}, up));
  EXPECT_FALSE(encloses(Slabs64{{0, 0, 0}, {&z, 1}}, up));  // it does, but no one says so
  EXPECT_TRUE(encloses(Sphere64{0, 0, 0, infinity}, up));
}

}  // namespace
}  // namespace catena::reference
