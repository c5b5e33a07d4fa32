#include "catena/core/scenes/snake.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "catena/core/error.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/test_pairs.h"

namespace catena {
namespace {

std::unique_ptr<Animation> open(const std::string& spec) { return SceneRegistry::instance().open(spec); }

/// All frames of a snake as what they are: runs of n spheres out of one row. Built from the frames alone.
struct Row {
  std::vector<Sphere> spheres;
  std::vector<std::size_t> tail;  // by frame: its first sphere in the row
  std::size_t n = 0;
};

Row row_of(const Animation& snake) {
  Row row;
  const Chain start = snake.frame(0);
  row.n = start.size();
  row.spheres.assign(start.spheres().begin(), start.spheres().end());
  row.tail = {0};
  for (std::uint32_t f = 1; f < snake.frames(); ++f) {
    const Chain chain = snake.frame(f);
    const auto known = row.spheres.begin() + static_cast<std::ptrdiff_t>(row.tail.back());
    const auto tail = std::find(known, row.spheres.end(), chain[0]);
    const auto shared = row.spheres.end() - tail;
    if (shared == 0 || !std::equal(tail, row.spheres.end(), chain.spheres().begin()))
      throw std::logic_error(fmt::format("frame {} does not go on where frame {} ended", f, f - 1));
    row.tail.push_back(static_cast<std::size_t>(tail - row.spheres.begin()));
    row.spheres.insert(row.spheres.end(), chain.spheres().begin() + shared, chain.spheres().end());
  }
  return row;
}

struct Found {
  std::vector<Pair> pairs;            // of the whole row, neighbours left out
  std::vector<std::size_t> by_frame;  // how many of them in each frame
  std::size_t neighbours = 0;         // overlaps of i with i + 1
  std::size_t near_along = 0;         // pairs less than 8 spheres apart along the tube
  long double margin = 1;             // least relative margin of the pairs
};

Found find(const Row& row) {
  Found found;
  for (const Pair& p : test::touching_pairs(row.spheres)) {
    if (p.j - p.i == 1) {
      ++found.neighbours;
      continue;
    }
    found.pairs.push_back(p);
    found.near_along += p.j - p.i < 8;
    found.margin = std::min(found.margin, -test::relative_excess(row.spheres[p.i], row.spheres[p.j]));
  }
  for (const std::size_t tail : row.tail)
    found.by_frame.push_back(static_cast<std::size_t>(std::ranges::count_if(
        found.pairs, [&](const Pair& p) { return p.i >= tail && p.j < tail + row.n; })));
  return found;
}

struct Snake {
  std::string name;
  std::uint32_t frames;
};
/// How gtest names one where it prints it.
void PrintTo(const Snake& snake, std::ostream* out) { *out << snake.name; }

class SnakeScene : public testing::TestWithParam<Snake> {
 protected:
  static std::unique_ptr<Animation> with(const std::string& parameters) {
    return open(GetParam().name + ":" + parameters);
  }
};

INSTANTIATE_TEST_SUITE_P(Paths, SnakeScene, testing::Values(Snake{"path1", 56}, Snake{"path2", 114}),
                         [](const auto& test) { return test.param.name; });

TEST_P(SnakeScene, ReachesThePapersFortyFivePairsAndNeverMore) {
  for (const std::uint32_t n : {1000, 1001, 1234, 2048, 5000, 10000, 12345, 50000, 150000, 1000000}) {
    SCOPED_TRACE(n);
    const Row row = row_of(*with(fmt::format("n={}", n)));
    const Found found = find(row);
    EXPECT_EQ(std::ranges::max(found.by_frame), 45u);
    EXPECT_EQ(found.pairs.size(), 45u) << "some pair is in no frame together with the others";
    EXPECT_GE(std::ranges::min(found.by_frame), 20u) << "the scene is never idle";
    EXPECT_LT(std::ranges::min(found.by_frame), 45u) << "the number of pairs changes from frame to frame";
    EXPECT_EQ(found.neighbours, row.spheres.size() - 1) << "the spheres are joined";
    EXPECT_EQ(found.near_along, 0u) << "only neighbours overlap along the tube";
    EXPECT_GT(found.margin, 1e-6L) << "no pair hangs on the last bit";
  }
}

RC_GTEST_PROP(SnakeProperty, AnyLengthReachesFortyFivePairsAndNeverMore, ()) {
  const auto n = *rc::gen::inRange<std::uint32_t>(1000, 20001);
  for (const char* name : {"path1", "path2"}) {
    const Found found = find(row_of(*open(fmt::format("{}:n={}", name, n))));
    RC_ASSERT(std::ranges::max(found.by_frame) == 45u);
    RC_ASSERT(found.pairs.size() == 45u);
  }
}

TEST_P(SnakeScene, CrawlsFromFrameToFrame) {
  for (const std::uint32_t n : {1, 2, 10, 300, 1000, 10000}) {
    SCOPED_TRACE(n);
    const auto snake = with(fmt::format("n={}", n));
    ASSERT_EQ(snake->frames(), GetParam().frames);
    Chain before = snake->frame(0);
    for (std::uint32_t f = 1; f < snake->frames(); ++f) {
      Chain chain = snake->frame(f);
      EXPECT_NE(chain[0], before[0]) << "frame " << f;
      EXPECT_GE(snake->shift(f), 1) << "frame " << f;
      before = std::move(chain);
    }
  }
  const Row row = row_of(*with("n=10000"));
  EXPECT_EQ(row.spheres.size(), 13500u);
  EXPECT_THROW(with("n=10")->frame(GetParam().frames), std::out_of_range);
}

TEST_P(SnakeScene, KeepsItsSpacing) {
  for (const double spacing : {1.2, 1.6, 2.5}) {
    const Row row = row_of(*with(fmt::format("n=10000,spacing={}", spacing)));
    for (std::size_t i = 0; i + 1 < row.spheres.size(); ++i) {
      const Sphere &a = row.spheres[i], &b = row.spheres[i + 1];
      ASSERT_NEAR(std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z), spacing, 2e-3) << i;
    }
  }
}

TEST_P(SnakeScene, LiesInAPlaneOnlyWhenAlignedWithTheAxes) {
  const Chain aligned = with("n=10000,align=axes")->frame(20), general = with("n=10000")->frame(20);
  float lifted = 0;
  std::size_t off_plane = 0;
  for (const Sphere& s : aligned.spheres()) {
    lifted = std::max(lifted, std::abs(s.z));
    off_plane += s.z != 0;
  }
  EXPECT_LE(lifted, 2.5f);
  EXPECT_LT(off_plane, 9u * 40u) << "only the nine crossings leave the plane";
  const auto extent = [&](float Sphere::*c) {
    const auto [low, high] = std::ranges::minmax(general.spheres(), {}, c);
    return high.*c - low.*c;
  };
  const float largest = std::max({extent(&Sphere::x), extent(&Sphere::y), extent(&Sphere::z)});
  for (float Sphere::*c : {&Sphere::x, &Sphere::y, &Sphere::z}) EXPECT_GT(extent(c), 0.2f * largest);
}

TEST_P(SnakeScene, KeepsItsPairsWhereverItLies) {
  for (const char* parameters :
       {"n=5000,align=axes", "n=5000,offset=100000", "n=5000,scale=1e-25", "n=5000,radius=3e7"}) {
    const auto snake = with(parameters);
    std::size_t most = 0;
    for (const std::uint32_t f : {0u, snake->frames() / 2, snake->frames() - 1}) {
      std::size_t pairs = 0;
      for (const Pair& p : test::touching_pairs(snake->frame(f).spheres())) pairs += p.j - p.i > 1;
      most = std::max(most, pairs);
    }
    EXPECT_EQ(most, 45u) << parameters;
  }
}

TEST_P(SnakeScene, WorksWithAnySpacingAndInAnyPlace) {
  for (const char* parameters :
       {"n=1000,spacing=0.05", "n=1000,spacing=1", "n=1000,spacing=100", "n=1000,scale=1e-44",
        "n=1000,offset=1e30", "n=1,spacing=100", "n=2,spacing=0.05", "n=50", "n=200", "n=500", "n=999"}) {
    const auto snake = with(parameters);
    EXPECT_NO_THROW(snake->frame(snake->frames() - 1)) << parameters;
  }
  EXPECT_THROW(with("n=2000000000"), InputError);
  EXPECT_THROW(with("n=1000,scale=1e-60"), InputError);
}

TEST(SnakeLong, TenMillionSpheresStayFinite) {
  for (const char* name : {"path1", "path2"})
    EXPECT_EQ(open(std::string(name) + ":n=10000000")->frame(9).size(), 10000000u);
}

}  // namespace
}  // namespace catena
