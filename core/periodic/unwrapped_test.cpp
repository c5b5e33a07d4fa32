#include "catena/core/periodic/unwrapped.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "catena/core/error.h"

namespace catena {
namespace {

// Whole numbers, so that cutting apart and putting together are exact.
RC_GTEST_PROP(Unwrapped, PutsTogetherWhatABoxHasCutApart, ()) {
  const PeriodicBox box{{16, 16, 16}, 4, 0, -2};
  std::vector<Sphere> whole, cut;
  Strands strands{{0}, {}};
  std::vector<Pair> joints;
  for (auto left = *rc::gen::inRange(1, 4); left > 0; --left) {
    const auto step = [] { return static_cast<float>(*rc::gen::inRange(-3, 4)); };
    const auto on = [&](const Sphere& s) { return Sphere{s.x + step(), s.y + step(), s.z + step(), 1}; };
    std::vector<Sphere> strand;
    for (auto more = *rc::gen::inRange(1, 12); more > 0; --more)
      strand.push_back(strand.empty() ? Sphere{0, 0, 0, 1} : on(strand.back()));
    // One of its spheres is joined to one of a strand before it.
    Sphere begins = strand[0];
    if (!whole.empty()) {
      const auto from = *rc::gen::inRange<std::size_t>(0, whole.size()),
                 to = *rc::gen::inRange<std::size_t>(0, strand.size());
      const Sphere joined = on(whole[from]);
      begins = {joined.x - strand[to].x, joined.y - strand[to].y, joined.z - strand[to].z, 1};
      joints.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(whole.size() + to)});
    }
    for (const Sphere& s : strand) {
      const Sphere at{begins.x + s.x, begins.y + s.y, begins.z + s.z, 1};
      whole.push_back(at);
      const auto boxes = [] { return static_cast<double>(*rc::gen::inRange(-2, 3)); };
      const auto by = box.along({boxes(), boxes(), boxes()});
      cut.push_back({at.x + static_cast<float>(by[0]), at.y + static_cast<float>(by[1]),
                     at.z + static_cast<float>(by[2]), 1});
    }
    strands.first.push_back(static_cast<std::uint32_t>(whole.size()));
    strands.closed.push_back(0);
  }
  const auto together = unwrapped(cut, strands, joints, box);
  const Sphere a = together[0], b = whole[0];
  for (std::size_t i = 0; i < whole.size(); ++i)
    RC_ASSERT(together[i] ==
              (Sphere{whole[i].x + a.x - b.x, whole[i].y + a.y - b.y, whole[i].z + a.z - b.z, 1}));
}

TEST(Unwrapped, RefusesARingAroundTheBox) {
  const std::vector<Sphere> ring{{0, 0, 0, 1}, {3, 0, 0, 1}, {6, 0, 0, 1}};
  try {
    unwrapped(ring, Strands::one_closed(3), {}, {{9, 9, 9}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("winds around the box between spheres 2 and 0"),
              std::string::npos);
  }
  EXPECT_EQ(unwrapped(ring, Strands::one_closed(3), {}, {{0, 9, 9}}), ring);
  // Where joints close it, too: of one strand, and of several whose every joint is looked at from both ends.
  const std::vector<Pair> joint{{0, 2}}, joints{{0, 1}, {1, 2}, {0, 2}};
  const Strands apart{{0, 1, 2, 3}, {0, 0, 0}};
  EXPECT_THROW(unwrapped(ring, {{0, 3}, {0}}, joint, {{9, 9, 9}}), InputError);
  EXPECT_THROW(unwrapped(ring, apart, joints, {{9, 9, 9}}), InputError);
  EXPECT_EQ(unwrapped(ring, apart, joints, {{0, 9, 9}}), ring);
  const std::vector<Sphere> fork{{0, 0, 0, 1}, {8, 0, 0, 1}, {1, 0, 0, 1}};
  for (const auto& named : {std::vector<Pair>{{0, 1}, {0, 2}}, {{1, 0}, {2, 0}}, {{2, 0}, {0, 1}}})
    EXPECT_EQ(unwrapped(fork, apart, named, {{9, 9, 9}})[1].x, -1);
}

}  // namespace
}  // namespace catena
