#include "catena/core/readers/curve_graph.h"

#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"

namespace catena {
namespace {

CurveFile arranged(const TestGraph& graph, bool keep_free) {
  CurveFile curves;
  curves.spheres = graph.points;
  curves.has_radii = true;
  for (const std::uint32_t point : arrange_along_edges(curves, graph.edges, keep_free))
    curves.labels.add(std::int64_t{point});
  return curves;
}

RC_GTEST_PROP(CurveGraph, KeepsEveryPointAndEveryEdgeOnce, (bool keep_free)) {
  const TestGraph graph = any_graph();
  is_the_graph(arranged(graph, keep_free), graph, 0, true, keep_free);
}

RC_GTEST_PROP(CurveGraph, HasNoMoreStrandsThanItNeeds, ()) {
  // Lines and rings, by points in any order: a strand for each, and no joint.
  const auto sizes = *rc::gen::container<std::vector<int>>(3, rc::gen::inRange(2, 6));
  std::vector<Pair> edges;
  std::uint32_t points = 0;
  for (const int size : sizes) {
    for (int k = 1; k < size; ++k) edges.push_back({points + k - 1, points + static_cast<std::uint32_t>(k)});
    if (size > 2) edges.push_back({points, points + size - 1});
    points += static_cast<std::uint32_t>(size);
  }
  CurveFile curves;
  curves.spheres.resize(points);
  arrange_along_edges(
      curves, *rc::gen::arbitrary<bool>() ? edges : std::vector<Pair>(edges.rbegin(), edges.rend()), true);
  RC_ASSERT(curves.joints.empty());
  RC_ASSERT(curves.strand_closed.size() == sizes.size());
  RC_ASSERT(std::ranges::count(curves.strand_closed, 1) ==
            std::ranges::count_if(sizes, [](int size) { return size > 2; }));
}

TEST(CurveGraph, CountsAnEdgeOnceAndNoneToItself) {
  CurveFile curves;
  curves.spheres.resize(3);
  arrange_along_edges(curves, std::vector<Pair>{{0, 1}, {1, 0}, {1, 2}, {2, 2}, {1, 2}}, false);
  EXPECT_EQ(curves.strand_closed, std::vector<std::uint8_t>{0});
  EXPECT_TRUE(curves.joints.empty());
  EXPECT_EQ(curves.spheres.size(), 3u);
}

// Both ends are ends, though their edges are written twice, and the strand begins at one of them.
TEST(CurveGraph, IsNotCutWhereEdgesAreWrittenTwice) {
  CurveFile curves;
  curves.spheres.resize(3);
  const auto order = arrange_along_edges(curves, std::vector<Pair>{{0, 1}, {1, 0}, {0, 2}, {0, 2}}, false);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{1, 0, 2}));
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_TRUE(curves.joints.empty());
}

RC_GTEST_PROP(CurveGraph, JoinsOnceWhatIsWrittenAnyNumberOfTimes, (bool keep_free)) {
  const TestGraph graph = any_graph();
  TestGraph repeated = graph;
  for (auto left = *rc::gen::inRange<std::size_t>(0, 9); left > 0 && !graph.edges.empty(); --left) {
    const Pair edge = *rc::gen::elementOf(graph.edges);
    repeated.edges.push_back(*rc::gen::arbitrary<bool>() ? edge : Pair{edge.j, edge.i});
  }
  const CurveFile curves = arranged(repeated, keep_free);
  is_the_graph(curves, graph, 0, true, keep_free);
  for (std::size_t k = 1; k < curves.joints.size(); ++k) RC_ASSERT(curves.joints[k - 1] < curves.joints[k]);
}

TEST(CurveGraph, JoinsABranchOnceBehindOthers) {
  CurveFile curves;
  curves.spheres.resize(5);
  arrange_along_edges(curves, std::vector<Pair>{{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 3}}, false);
  EXPECT_EQ(curves.joints.size(), 2u);
}

TEST(CurveGraph, KeepsAPointWithAnEdgeToItself) {
  CurveFile curves;
  curves.spheres.resize(5);
  const auto order = arrange_along_edges(curves, std::vector<Pair>{{1, 1}, {3, 4}, {3, 3}, {1, 1}}, false);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{3, 4, 1}));
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(curves.strand_closed, (std::vector<std::uint8_t>{0, 0}));
  EXPECT_TRUE(curves.joints.empty());
}

TEST(CurveGraph, TiesALoopToItsStem) {
  CurveFile curves;
  curves.spheres.resize(5);
  arrange_along_edges(curves, std::vector<Pair>{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 1}}, false);
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 5}));
  EXPECT_EQ(curves.joints, (std::vector<Pair>{{1, 4}}));
}

TEST(CurveGraph, MovesAllFramesAlike) {
  CurveFile curves;
  curves.spheres = {{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}};
  curves.later_frames = {{{5, 0, 0, 1}, {6, 0, 0, 1}, {7, 0, 0, 1}}};
  arrange_along_edges(curves, std::vector<Pair>{{2, 1}, {0, 2}}, false);
  EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{0, 0, 0, 1}, {2, 0, 0, 1}, {1, 0, 0, 1}}));
  EXPECT_EQ(curves.later_frames[0], (std::vector<Sphere>{{5, 0, 0, 1}, {7, 0, 0, 1}, {6, 0, 0, 1}}));
}

}  // namespace
}  // namespace catena
