#include <fmt/format.h>

#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"

namespace catena {
namespace {

std::string obj_of(const TestGraph& graph) {
  std::string text = "# test\n";
  for (const Sphere& p : graph.points) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const Pair& edge : graph.edges)
    text += *rc::gen::arbitrary<bool>()
                ? fmt::format("l {} {}\n", edge.i + 1, edge.j + 1)
                : fmt::format("l {} {}\n", int(edge.i) - int(graph.points.size()), edge.j + 1);
  return text;
}

RC_GTEST_PROP(ObjReader, ReadsWhatIsWritten, ()) {
  const TestGraph graph = any_graph();
  is_the_graph(read_text("a.obj", obj_of(graph)), graph, 1, false, false);
}

TEST(ObjReader, TakesLinesOfManyVerticesTexturesAndContinuations) {
  const auto curves =
      read_text("a.obj", "o rope\nv 0 0 0 1\nv 1 0 0\nv 2 0 0 0.1 0.2 0.3\nvt 0 0\ng a\nl 1/1 2/1 \\\n3/1\n");
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(curves.labels.of(2), "3");
  EXPECT_TRUE(curves.warnings.empty());
}

TEST(ObjReader, SaysWhatItLeavesOut) {
  const auto curves = read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nl 1 2\nf 1 2 3\n");
  ASSERT_EQ(curves.warnings.size(), 2u);
  EXPECT_EQ(curves.warnings[0], "1 vertex is on no line and left out");
  EXPECT_EQ(curves.warnings[1], "1 face is no curve and left out");
}

TEST(ObjReader, TakesPointsAsStrandsOfTheirOwn) {
  const auto curves = read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\np -4 1\nl 3 4\np 4\n");
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2, 3, 4}));
  std::vector<std::string> labels;
  for (std::uint32_t i = 0; i < 4; ++i) labels.push_back(curves.labels.of(i));
  EXPECT_EQ(labels, (std::vector<std::string>{"3", "4", "1", "2"}));
  EXPECT_EQ(curves.warnings, (std::vector<std::string>{"1 vertex is on no line and left out"}));
}

TEST(ObjReader, SaysThatItDoesNotSampleFreeFormCurves) {
  const std::string curve = "v 0 0 0\nv 1 0 0\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nend\n";
  EXPECT_EQ(read_text("a.obj", curve + "l 1 2\n").warnings,
            (std::vector<std::string>{"1 free-form curve left out; export it as a polyline"}));
  EXPECT_COMPLAINT("6: the file has no lines ('l 1 2 3'), but vertices: 2, faces: 0, free-form curves: 1", "a.obj", curve);
}

TEST(ObjReader, SaysWhatIsNoStatement) {
  const std::string line = "v 0 0 0\nv 1 0 0\nusemtl a\nvt 0 0\nl 1 2\n";
  EXPECT_TRUE(read_text("a.obj", line).warnings.empty());
  EXPECT_EQ(read_text("a.obj", line + "w 2 0 0\n").warnings,
            (std::vector<std::string>{"line 6: 'w' is no statement of OBJ"}));
  EXPECT_EQ(read_text("a.obj", line + "w 2 0 0\nV 1 1 1\nv1 1 1\n").warnings,
            (std::vector<std::string>{"line 6: 'w' is no statement of OBJ, nor are 2 more"}));
}

TEST(ObjReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("2: the file has no lines ('l 1 2 3'), but vertices: 1, faces: 1", "a.obj",
                   "v 0 0 0\nf 1 1 1\n");
  EXPECT_COMPLAINT("2: vertex 2 of 1 is named", "a.obj", "v 0 0 0\nl 1 2\n");
  EXPECT_COMPLAINT("3: vertex 3 of 2 is named", "a.obj", "v 0 0 0\nv 1 0 0\nl 1 2 3\n");
  EXPECT_COMPLAINT("2: vertex 9 of 2 is named", "a.obj", "v 0 0 0\nl 1 9\nl 9 1\nl 1 2\nv 1 0 0\n");
  EXPECT_COMPLAINT("2: a point needs a vertex", "a.obj", "v 0 0 0\np\nl 1 1\n");
  EXPECT_COMPLAINT("2: vertex '0' is not", "a.obj", "v 0 0 0\nl 0 1\n");
  EXPECT_COMPLAINT("2: vertex '-2' is not", "a.obj", "v 0 0 0\nl -2 1\n");
  EXPECT_COMPLAINT("2: a line needs two vertices", "a.obj", "v 0 0 0\nl 1\n");
  EXPECT_COMPLAINT("1: a vertex needs three coordinates, got 2", "a.obj", "v 0 0\n");
  EXPECT_COMPLAINT("1: y 'a' is not a number", "a.obj", "v 0 a 0\n");
  EXPECT_COMPLAINT("2: the last line goes on", "a.obj", "v 0 0 0\nl 1 \\\n");
}

}  // namespace
}  // namespace catena
