#include <algorithm>
#include <set>

#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

// Every sample opens, and every reader has one but those whose format no small file shows better than its
// test.
TEST(Examples, AllOpen) {
  std::set<std::string> extensions;
  for (const auto& entry : std::filesystem::directory_iterator(example(""))) {
    if (!ReaderRegistry::instance().knows(entry.path())) continue;
    const CurveFile curves = ReaderRegistry::instance().read(entry.path());
    EXPECT_GT(curves.spheres.size(), 3u) << entry.path();
    extensions.insert(entry.path().extension().string());
  }
  for (const ReaderInfo& reader : ReaderRegistry::instance().readers()) {
    const bool shown =
        std::ranges::any_of(reader.extensions, [&](const auto& e) { return extensions.contains(e); });
    EXPECT_TRUE(shown || reader.name == "Cem Yuksel hair" || reader.name == "Geomview VECT") << reader.name;
  }
}

TEST(Examples, SayWhatTheyShow) {
  const auto read = [](const char* name) { return ReaderRegistry::instance().read(example(name)); };
  for (const char* name : {"branch.vtk", "branch.vtp"}) {
    EXPECT_EQ(read(name).joints.size(), 1u) << name;
    EXPECT_EQ(read(name).spheres[6].radius, 0.2f) << name;
  }
  EXPECT_EQ(read("loop.obj").joints, (std::vector<Pair>{{1, 5}}));
  EXPECT_EQ(read("melt.data").strand_first, (std::vector<std::uint32_t>{0, 4, 8}));
  EXPECT_EQ(read("melt.dump").later_frames.size(), 1u);
  EXPECT_EQ(read("strand.conf").boxes.size(), 1u);
  EXPECT_EQ(read("tracts.tck").spheres, read("tracts.trk").spheres);
  const CurveFile peptide = read("peptide.cif");
  EXPECT_EQ(peptide.spheres.size(), 4u);
  EXPECT_EQ(peptide.strand_closed.size(), 1u);
  EXPECT_EQ(peptide.spheres[2], (Sphere{6.1f, 0.1f, 0, 0}));
  EXPECT_EQ(peptide.labels.of(1), "A/MSE6/CA");
}

}  // namespace
}  // namespace catena
