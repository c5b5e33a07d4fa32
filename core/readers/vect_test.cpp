#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

TEST(VectReader, ReadsOpenAndClosedPolylinesAndNoColours) {
  const CurveFile curves = read_text("a.vect",
                                     "VECT # keyword\n# comment\n2 5 1 # totals\n-3 2\n1 0\n"
                                     "0 0 0  1 0 0 # two on a line\n1 1\n0\n"
                                     "5 5 5\n6 6 6\n# colours\n0 1 0 1\n");
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 3, 5}));
  EXPECT_EQ(curves.strand_closed, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(curves.spheres[2], (Sphere{1, 1, 0, 0}));
  EXPECT_FALSE(curves.has_radii);
}

TEST(VectReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("1: a VECT file starts with", "a.vect", "4VECT 1 1 0");
  EXPECT_COMPLAINT("5: the file is truncated", "a.vect", "VECT\n1 2 0\n2\n0\n0 0 0 1 1\n");
  EXPECT_COMPLAINT("5: the file is truncated: it ends where a colour", "a.vect",
                   "VECT\n1 1 1\n1\n1\n0 0 0 1 1 1\n");
  EXPECT_COMPLAINT("3: the vertex counts of the polylines sum to 2, the header says 3", "a.vect",
                   "VECT\n1 3 0\n2\n0\n");
  EXPECT_COMPLAINT("4: the colour counts of the polylines sum to 1, the header says 2", "a.vect",
                   "VECT\n1 1 2\n1\n1\n0 0 0\n1 1 1 1\n0 0 0 0\n");
  EXPECT_COMPLAINT("3: vertex count -9223372036854775808 exceeds", "a.vect",
                   "VECT\n1 3 0\n-9223372036854775808\n0\n");
  EXPECT_COMPLAINT("2: number of vertices 4000000000 is more than", "a.vect",
                   "VECT\n1 4000000000 0\n4000000000 0\n");
  EXPECT_COMPLAINT("2: number of polylines '-1' must be", "a.vect", "VECT\n-1 3 0\n");
  EXPECT_COMPLAINT("4: z 'inf' is not a finite number", "a.vect", "VECT\n1 1 0 1\n0\n0 0 inf\n");
  EXPECT_COMPLAINT("5: '9' stands after all that the header declares, vertices: 2, colours: 0", "a.vect",
                   "VECT\n1 2 0\n2\n0\n0 0 0 1 1 1 9 9 9\n");
  EXPECT_COMPLAINT("2: 'x' stands after", "a.vect", "VECT 1 1 0 1 0 0 0 0\nx\n");
  EXPECT_COMPLAINT(" holds no points", "a.vect", "VECT 0 0 0");
}

}  // namespace
}  // namespace catena
