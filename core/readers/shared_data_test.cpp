#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "catena/core/readers/test_file.h"

/// The real files beside the repository, when there are any, with the counts of their NOTICE.tsv.
namespace catena {
namespace {

struct Counts {
  std::size_t points, parts;  ///< connected parts: strands that no joint ties together
};

const std::map<std::string, Counts> counts{
    {"chromatin/K562.nucle3d", {12137, 23}},
    {"hair/Ratboy_mohawk.tfx", {71296, 2228}},
    {"hair/sintel_ragged.hair", {6121, 228}},
    {"hair/sintel_ragged_thickness.hair", {6121, 228}},
    {"hair/sintel_uniform_nosegments.hair", {7296, 228}},
    {"hair/sintel_usc.data", {6123, 230}},  // two strands of one vertex more than its notice counts
    {"intestine/Edin90_small_xyzr.csv", {2870, 1}},
    {"knot/12n_838-braid.obj", {360, 1}},
    {"knot/3_1_328.vect", {328, 1}},
    {"knot/4_1-smooth.obj", {272, 1}},
    {"knot/9_47-cubiclattice.txt", {208, 1}},
    {"knot/circle_closure_0.vect", {593, 1}},
    {"knot/curves_catmullrom.bcc", {933, 3}},
    {"knot/curves_polyline.bcc", {933, 3}},
    {"knot/repcurves_earbuds.obj", {529, 1}},
    {"knot/repcurves_rings640.obj", {6144, 3}},
    {"neuron/1734350788.swc", {4465, 1}},
    {"neuron/Neuron.swc", {847, 1}},
    {"neuron/Neuron_3_random_walker_branches.swc", {1503, 1}},
    {"neuron/Neuron_disconnected_components.swc", {843, 5}},
    {"neuron/Neuron_missing_ids.swc", {8, 3}},
    {"neuron/Neuron_missing_parents.swc", {843, 5}},
    {"neuron/Neuron_zero_length_segments.swc", {847, 1}},
    {"neuron/Neuron_zero_radius.swc", {9, 1}},
    {"neuron/multiple_soma.swc", {10, 2}},
    {"neuron/multiple_somata.swc", {10, 2}},
    {"neuron/non_increasing_trunk_off_1_16pt.swc", {16, 1}},
    {"neuron/simple-trailing-space.swc", {3, 1}},
    {"neuron/simple-windows-eol.swc", {9, 1}},
    {"protein/1A8O.pdb", {70, 1}},
    {"protein/2BEG.pdb", {130, 5}},
    {"protein/2efv.pdb", {82, 1}},
    {"protein/disordered.pdb", {6, 1}},
    {"rod/overhand_n1.txt", {301, 1}},
    {"rod/overhand_n2.txt", {301, 1}},
    {"rod/overhand_n3.txt", {301, 1}},
    {"rod/overhand_n4.txt", {301, 1}},
    {"tract/complex_big_endian.trk", {8, 3}},
    {"tract/matlab_nan.tck", {108, 1}},
    {"tract/tracks300.trk", {14576, 300}},
    {"vessel/penetrating_artery.vtk", {1274, 1}},
    {"vessel/penetrating_artery_diameters_on_points.vtk", {1274, 1}},
};

std::filesystem::path shared_data() { return std::filesystem::path(CATENA_SOURCE_DIR) / "../shared/data"; }

class SharedData : public testing::TestWithParam<std::pair<const std::string, Counts>> {};

TEST_P(SharedData, HasTheCountsOfItsNotice) {
  const auto& [name, expected] = GetParam();
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no real files at " << shared_data();
  // x y z theta: four numbers in a row, which do not say what they are.
  const bool rod = name.starts_with("rod/");
  if (rod) {
    EXPECT_THROW(ReaderRegistry::instance().read(shared_data() / name), InputError);
  }
  const ReadOptions options{.columns = rod ? std::vector<std::string>{"x", "y", "z", "_"}
                                           : std::vector<std::string>{}};
  const CurveFile curves = ReaderRegistry::instance().read(shared_data() / name, options);
  EXPECT_EQ(curves.spheres.size(), expected.points);
  EXPECT_EQ(curves.strand_closed.size() - curves.joints.size(), expected.parts);
}

INSTANTIATE_TEST_SUITE_P(RealFiles, SharedData, testing::ValuesIn(counts.begin(), counts.end()),
                         [](const auto& file) {
                           std::string name = file.param.first;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

TEST(SharedDataFiles, RepeatedIdIsRefused) {
  const auto file = shared_data() / "neuron/repeated_id.swc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no real files at " << shared_data();
  EXPECT_THROW(ReaderRegistry::instance().read(file), InputError);
}

// 160 lines tie 162 points into three parts, of which two branch: more strands than parts and joints would
// tell.
TEST(SharedDataFiles, VesselsBranch) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no real files at " << shared_data();
  const CurveFile curves = ReaderRegistry::instance().read(shared_data() / "vessel/one_loop.vtk");
  EXPECT_EQ(curves.spheres.size(), 162u);
  EXPECT_EQ(curves.strand_closed.size(), 10u);
  EXPECT_EQ(curves.joints.size(), 8u);
}

TEST(SharedDataFiles, EveryFileOfAKnownKindHasCounts) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no real files at " << shared_data();
  const std::set<std::string> elsewhere{"neuron/repeated_id.swc",
                                        "vessel/one_loop.vtk"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_data())) {
    const std::string name = std::filesystem::relative(entry.path(), shared_data()).string();
    if (entry.is_regular_file() && ReaderRegistry::instance().knows(name) && !elsewhere.contains(name)) {
      EXPECT_TRUE(counts.contains(name)) << name;
    }
  }
}

TEST(SharedDataFiles, RadiiAreThoseOfTheirNotice) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no real files at " << shared_data();
  const auto extremes = [](const char* name) {
    const CurveFile curves = ReaderRegistry::instance().read(shared_data() / name);
    const auto [least, greatest] = std::ranges::minmax(curves.spheres, {}, &Sphere::radius);
    return std::pair(least.radius, greatest.radius);
  };
  EXPECT_EQ(extremes("hair/sintel_ragged.hair"), std::pair(0.05f, 0.05f));
  EXPECT_FLOAT_EQ(extremes("hair/sintel_ragged_thickness.hair").first, 0.0135f);
  EXPECT_FLOAT_EQ(extremes("hair/sintel_ragged_thickness.hair").second, 0.06f);
  EXPECT_EQ(extremes("neuron/1734350788.swc"), std::pair(10.f, 375.f));
  EXPECT_FLOAT_EQ(extremes("vessel/penetrating_artery.vtk").first, 10.5247f);
  EXPECT_FLOAT_EQ(extremes("vessel/penetrating_artery_diameters_on_points.vtk").first, 10.5247f);
  EXPECT_FLOAT_EQ(extremes("vessel/one_loop.vtk").second, 2.7426f);
  EXPECT_FLOAT_EQ(extremes("intestine/Edin90_small_xyzr.csv").second, 32.7222f);
}

}  // namespace
}  // namespace catena
