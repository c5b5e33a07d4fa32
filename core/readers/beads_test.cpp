#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>

#include "catena/core/readers/lammps_atom_style.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"

/// Files of simulations: LAMMPS data and dumps, oxDNA.
namespace catena {
namespace {

std::vector<std::uint32_t> any_order(std::size_t n) {
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t k = 1; k < n; ++k) std::swap(order[k], order[*rc::gen::inRange<std::size_t>(0, k + 1)]);
  return order;
}

std::string data_of(const TestGraph& graph, bool full, bool images, bool named) {
  std::string text = fmt::format(
      "a melt\n\n{} atoms\n{} bonds\n1 atom types\n\n-5.0 5.0 xlo xhi\n0 8 ylo yhi\n0 9 zlo zhi\n0.5 0 0 xy "
      "xz yz\n\nMasses\n\n1 1\n\nAtoms{}\n\n",
      graph.points.size(), graph.edges.size(), named ? full ? " # full" : " # bond" : "");
  for (const std::uint32_t k : any_order(graph.points.size())) {
    const Sphere& p = graph.points[k];
    text += fmt::format("{} 1 1 {}{} {} {}{}\n", k + 1, full ? "0.5 " : "", p.x, p.y, p.z,
                        images ? " 0 -1 0" : "");
  }
  text += "\nVelocities\n\n1 0 0 0\n\nBonds\n\n";
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    text += fmt::format("{} 1 {} {}\n", e + 1, graph.edges[e].j + 1, graph.edges[e].i + 1);
  return text;
}

RC_GTEST_PROP(LammpsDataReader, ReadsWhatIsWritten, (bool full, bool images, bool named)) {
  const TestGraph graph = any_graph();
  const CurveFile curves = read_text("a.data", data_of(graph, full, images, named));
  is_the_graph(curves, graph, 1, false, true);
  RC_ASSERT(curves.boxes == (std::vector<PeriodicBox>{{{10, 8, 9}, 0.5, 0, 0}}));
  RC_ASSERT(!curves.box_is_periodic);
}

TEST(LammpsDataReader, TiesMoleculesWithoutBondsAndTakesDiameters) {
  const auto curves =
      read_text("a.data", "t\n\n3 atoms\n\nAtoms # molecular\n\n3 7 1 2 0 0\n1 7 1 0 0 0\n2 0 1 9 9 9\n");
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(curves.labels.of(1), "3");
  const auto spheres = read_text("a.data", "t\n\n1 atoms\n\nAtoms # sphere\n\n1 1 4 1.0 5 6 7\n");
  EXPECT_EQ(spheres.spheres[0], (Sphere{5, 6, 7, 2}));
  EXPECT_TRUE(spheres.has_radii);
}

// LAMMPS writes molecule 0 of atoms that are of none.
TEST(LammpsDataReader, TiesNoAtomsThatAreOfNoMolecule) {
  const auto curves = read_text(
      "a.data", "t\n\n4 atoms\n\nAtoms # molecular\n\n1 0 1 0 0 0\n2 0 1 9 9 9\n3 5 1 1 0 0\n4 5 1 2 0 0\n");
  EXPECT_EQ(curves.strand_closed.size(), 3u);
  EXPECT_TRUE(curves.joints.empty());
}

// The columns of a row that are not read are 77, so that one taken for a coordinate shows.
RC_GTEST_PROP(LammpsDataReader, ReadsEveryStyle, (bool flags, bool kokkos)) {
  const auto styles = lammps_atom_styles();
  const LammpsAtomStyle& style = styles[*rc::gen::inRange<std::size_t>(0, styles.size())];
  const auto atoms = *rc::gen::inRange<std::uint32_t>(1, 5);
  std::string text = fmt::format("t\n\n{} atoms\n\nAtoms # {}{}\n\n", atoms, style.name, kokkos ? "/kk" : "");
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < atoms; ++k) {
    spheres.push_back({*any_finite(), *any_finite(), *any_finite(), style.diameter ? 2.0f : 0.0f});
    std::vector<std::string> row(style.columns + (flags ? 3 : 0), "77");
    row[0] = std::to_string(k + 1);
    if (style.diameter) row[*style.diameter] = "4";
    for (const auto& [at, value] : {std::pair(0, spheres[k].x), {1, spheres[k].y}, {2, spheres[k].z}})
      row[style.x + static_cast<std::size_t>(at)] = fmt::format("{}", value);
    text += fmt::format("{}\n", fmt::join(row, " "));
  }
  const CurveFile curves = read_text("a.data", text);
  RC_ASSERT(curves.spheres == spheres);
  RC_ASSERT(curves.has_radii == style.diameter.has_value());
  RC_ASSERT(curves.warnings.empty() == style.molecule.has_value());
  const auto of_hybrid = [](const std::string& warning) {
    return warning.find("hybrid") != std::string::npos;
  };
  RC_ASSERT(std::ranges::any_of(curves.warnings, of_hybrid) == (style.name == "hybrid"));
}

TEST(LammpsDataReader, SaysWhatIsWrong) {
  const std::string start = "t\n\n2 atoms\n\n";
  EXPECT_COMPLAINT("7: what the columns are, of which there are 6, is not told", "a.data",
                   start + "Atoms\n\n1 1 1 0 0 0\n2 1 1 0 0 0\n");
  EXPECT_COMPLAINT("5: 'edpt' behind Atoms is no style", "a.data", start + "Atoms # edpt\n\n1 1 1 0 0 0\n");
  EXPECT_COMPLAINT("5: 'full extra' behind Atoms is no style", "a.data",
                   start + "Atoms # full extra\n\n1 1 1 0 0 0 0\n2 1 1 0 0 0 0\n");
  EXPECT_COMPLAINT("7: an atom of style bond has 6 columns, perhaps 3 image flags more, not 7", "a.data",
                   start + "Atoms # bond\n\n1 1 1 0.5 0 0 0\n2 1 1 0.5 0 0 0\n");
  EXPECT_COMPLAINT("7: an atom of style atomic has 5 columns, perhaps 3 image flags more, not 8", "a.data",
                   start + "Atoms # atomic\n\n1 1 1 1 1 0.5 0 0\n");
  EXPECT_COMPLAINT("8: what the columns are, of which there are 8, is not told", "a.data",
                   start + "Atoms\n\n1 1 1 1 1 0 0 0\n2 1 1 1 1 0.5 0 0\n");  // of bpm/sphere
  EXPECT_COMPLAINT("7: the header says 2 atoms, the file has 1", "a.data",
                   start + "Atoms # bond\n\n1 1 1 0 0 0\n");
  EXPECT_COMPLAINT("5: the header says 0 atoms, the file has 1", "a.data",
                   "t\n\nAtoms # bond\n\n1 1 1 0 0 0\n");
  EXPECT_COMPLAINT(" atom 1 comes twice in frame 0", "a.data",
                   start + "Atoms # bond\n\n1 1 1 0 0 0\n1 1 1 0 0 0\n");
  EXPECT_COMPLAINT("13: a bond names atom 3", "a.data",
                   "t\n\n2 atoms\n1 bonds\n\nAtoms # bond\n\n1 1 1 0 0 0\n2 1 1 0 0 0\n\nBonds\n\n1 1 1 3\n");
  EXPECT_COMPLAINT("4: the file has no section Atoms", "a.data", start);
  const std::string two =
      "t\n\n2 atoms\n2 bonds\n0 2 xlo xhi\n0 3 ylo yhi\n0 4 zlo zhi\n0.1 0.2 0.3 xy xz yz\n\n"
      "Atoms # bond\n\n1 1 1 0 0 0\n2 1 1 0 0 0\n";
  EXPECT_COMPLAINT("17: the header says 2 bonds, the file has 1", "a.data", two + "\nBonds\n\n1 1 1 2\n");
  EXPECT_EQ(read_text("a.data", two + "\nBonds\n\n1 1 1 2\n2 1 2 1\n").boxes,
            (std::vector<PeriodicBox>{{{2, 3, 4}, 0.1, 0.2, 0.3}}));
  EXPECT_COMPLAINT("8: the atom has 9 columns, those before it 6", "a.data",
                   start + "Atoms # bond\n\n1 1 1 0 0 0\n2 1 1 0 0 0 0 0 0\n");
}

std::string dump_of(const std::vector<std::vector<Sphere>>& frames, bool scaled) {
  std::string text;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    text += fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp ff pp\n0 16\n0 8\n-2 6\nITEM: "
        "ATOMS type {}\n",
        f, frames[f].size(), scaled ? "xs ys zs id radius mol" : "xu yu zu id radius mol");
    for (const std::uint32_t k : any_order(frames[f].size())) {
      const Sphere& p = frames[f][k];
      text += scaled ? fmt::format("1 {} {} {} {} {} 1\n", p.x / 16, p.y / 8, (p.z + 2) / 8, k + 1, p.radius)
                     : fmt::format("1 {} {} {} {} {} 1\n", p.x, p.y, p.z, k + 1, p.radius);
    }
  }
  return text;
}

RC_GTEST_PROP(LammpsDumpReader, ReadsAllFramesInTheOrderOfTheIds, (bool scaled)) {
  const auto n = *rc::gen::inRange<std::size_t>(1, 6);
  std::vector<std::vector<Sphere>> frames(*rc::gen::inRange<std::size_t>(1, 4));
  const auto any = [] {
    return static_cast<float>(*rc::gen::inRange(-64, 64)) / 16;
  };  // scaling these is exact
  for (auto& frame : frames)
    for (std::size_t k = 0; k < n; ++k) frame.push_back({any(), any(), any(), std::abs(any())});
  const CurveFile curves = read_text("a.dump", dump_of(frames, scaled));
  RC_ASSERT(curves.spheres == frames[0]);
  RC_ASSERT(curves.later_frames == std::vector<std::vector<Sphere>>(frames.begin() + 1, frames.end()));
  RC_ASSERT(curves.boxes == std::vector<PeriodicBox>(frames.size(), PeriodicBox{{16, 0, 8}}));
  RC_ASSERT(curves.has_radii);
  RC_ASSERT(curves.strand_closed.size() == 1u);
}

TEST(LammpsDumpReader, TakesBondsFromATopologyAndTheTrueBoxOfATiltedOne) {
  const TestFile data(
      "bonds.data",
      "t\n\n3 atoms\n1 bonds\n\nAtoms # bond\n\n1 1 1 0 0 0\n2 1 1 0 0 0\n3 1 1 0 0 0\n\nBonds\n\n1 1 3 1\n");
  const TestFile dump("a.dump",
                      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS xy xz yz pp pp pp\n-1 "
                      "12 2\n0 5 -1\n0 4 0\nITEM: ATOMS id x y z\n"
                      "1 0 0 0\n2 1 0 0\n3 2 0 0\n");
  const auto curves = ReaderRegistry::instance().read(dump.path(), {.topology = data.path().string()});
  EXPECT_EQ(curves.labels.of(1), "3");
  EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(curves.boxes, (std::vector<PeriodicBox>{{{10, 5, 4}, 2, -1, 0}}));
}

// All tilts to one side, so that they add up; fractions are along the edges; what does not say pp has no
// length.
TEST(LammpsDumpReader, TakesFractionsOfATiltedBoxThatIsNotPeriodicAlongZ) {
  const auto curves = read_text("a.dump",
                                "ITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp fs\n1 16 2\n2 8 "
                                "3\n3 7 1\nITEM: ATOMS id xs ys zs\n1 0 0 0\n2 0.5 0.25 0.75\n");
  EXPECT_EQ(curves.boxes, (std::vector<PeriodicBox>{{{10, 5, 0}, 2, 3, 1}}));
  EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{1, 2, 3, 0}, {8.75f, 4, 6, 0}}));
}

// Whatever the sides of its tilts, the bounds that a dump tells are those of the whole box.
RC_GTEST_PROP(LammpsDumpReader, TakesTheTrueBoxOfAnyTilts, ()) {
  const auto whole = [](int low, int high) { return static_cast<double>(*rc::gen::inRange(low, high)); };
  const double xy = whole(-9, 10), xz = whole(-9, 10), yz = whole(-9, 10);
  const std::array low{whole(-9, 10), whole(-9, 10), whole(-9, 10)}, length{whole(1, 9), whole(1, 9), whole(1, 9)};
  std::array<double, 3> least = low, most = low;
  for (int corner = 0; corner < 8; ++corner) {
    const double a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
    const std::array at{low[0] + a * length[0] + b * xy + c * xz, low[1] + b * length[1] + c * yz,
                        low[2] + c * length[2]};
    for (std::size_t k = 0; k < 3; ++k) least[k] = std::min(least[k], at[k]), most[k] = std::max(most[k], at[k]);
  }
  const std::string text = fmt::format(
      "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n{} {} {}\n{} {} {}\n{} {} {}\n"
      "ITEM: ATOMS id xs ys zs\n1 0 0 0\n",
      least[0], most[0], xy, least[1], most[1], xz, least[2], most[2], yz);
  const CurveFile curves = read_text("a.dump", text);
  RC_ASSERT(curves.boxes == (std::vector<PeriodicBox>{{length, xy, xz, yz}}));
  RC_ASSERT(curves.spheres[0] ==
            (Sphere{static_cast<float>(low[0]), static_cast<float>(low[1]), static_cast<float>(low[2]), 0}));
}

// Each frame names its own columns.
TEST(LammpsDumpReader, TakesFractionsOnlyInFramesThatSaySo) {
  const auto frame = [](const std::string& columns, const std::string& row) {
    return "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 8\n0 8\n0 8\nITEM: ATOMS id " + columns + "\n1 " +
           row + "\n";
  };
  const std::string scaled = frame("xs ys zs", "0.5 0.25 0.75"), plain = frame("x y z", "0.5 0.25 0.75");
  const Sphere of_scaled{4, 2, 6, 0}, of_plain{0.5f, 0.25f, 0.75f, 0};
  const CurveFile curves = read_text("a.dump", scaled + plain + scaled);
  EXPECT_EQ(curves.spheres, (std::vector<Sphere>{of_scaled}));
  EXPECT_EQ(curves.later_frames, (std::vector<std::vector<Sphere>>{{of_plain}, {of_scaled}}));
  for (const char* names : {"radius diameter", "diameter radius"}) {
    const bool first = names[0] == 'r';
    EXPECT_EQ(read_text("a.dump", frame(std::string("x y z ") + names, first ? "0 0 0 3 6.0001" : "0 0 0 6 3")).spheres[0].radius,
              3.0f)
        << names;
  }
}

// As versions of LAMMPS before 2010 wrote it.
TEST(LammpsDumpReader, DoesNotTakeABoxForPeriodicThatDoesNotSaySo) {
  const std::string rest = "0 9\n0 9\n0 9\nITEM: ATOMS id x y z\n1 0 0 0\n",
                    start = "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS";
  EXPECT_FALSE(read_text("a.dump", start + "\n" + rest).box_is_periodic);
  EXPECT_EQ(read_text("a.dump", start + "\n" + rest).boxes, (std::vector<PeriodicBox>{{{9, 9, 9}}}));
  EXPECT_TRUE(read_text("a.dump", start + " pp fs pp\n" + rest).box_is_periodic);
  EXPECT_COMPLAINT("3: 'ITEM: BOX BOUNDS' has three words", "a.dump", start + " pp\n" + rest);
}

TEST(LammpsDumpReader, SaysWhatIsWrong) {
  const std::string start =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n";
  EXPECT_COMPLAINT("1: 'ITEM: ...' is due", "a.dump", "hello\n");
  EXPECT_COMPLAINT("9: the columns lack id", "a.dump", start + "ITEM: ATOMS x y z\n0 0 0\n");
  EXPECT_COMPLAINT("10: an atom of 3 columns, but 4 are named", "a.dump",
                   start + "ITEM: ATOMS id x y z\n0 0 0\n");
  EXPECT_COMPLAINT("9: the file is truncated", "a.dump", start + "ITEM: ATOMS id x y z\n");
  EXPECT_COMPLAINT(
      "19: this frame and the first differ in having radii", "a.dump",
      start + "ITEM: ATOMS id x y z radius\n1 0 0 0 1\n" + start + "ITEM: ATOMS id x y z\n1 0 0 0\n");
  EXPECT_COMPLAINT(" frame 1 has not the same atoms", "a.dump",
                   start + "ITEM: ATOMS id x y z\n1 0 0 0\n" + start + "ITEM: ATOMS id x y z\n2 0 0 0\n");
}

/// A configuration with its topology beside it.
CurveFile read_oxdna(const std::string& topology, const std::string& configuration) {
  const TestFile top("a.top", topology), file("a.conf", configuration);
  return ReaderRegistry::instance().read(file.path(), {.topology = top.path().string()});
}

std::string configuration_of(const std::vector<Sphere>& points, int frames) {
  std::string text;
  for (int t = 0; t < frames; ++t) {
    text += fmt::format("t = {}\nb = 20 30 40\nE = 0 0 0\n", t);
    for (const Sphere& p : points) text += fmt::format("{} {} {} 1 0 0 0 0 1 0 0 0 0 0 0\n", p.x, p.y, p.z);
  }
  return text;
}

RC_GTEST_PROP(OxdnaReader, ReadsOldAndNewTopologies, ()) {
  std::string old_rows, new_rows;
  TestGraph graph;
  std::uint32_t strands = 0, n = 0;
  for (auto left = *rc::gen::inRange(1, 4); left > 0; --left, ++strands) {
    const auto size = *rc::gen::inRange<std::uint32_t>(1, 6);
    const bool circular = size > 2 && *rc::gen::arbitrary<bool>();
    new_rows += "A(7)GTC"[0] + std::string(size - 1, 'C') + (circular ? " type=DNA circular=true\n" : "\n");
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::uint32_t before = n + (k + size - 1) % size, after = n + (k + 1) % size;
      old_rows += fmt::format("{} A {} {}\n", strands + 1, k > 0 || circular ? int(before) : -1,
                              k + 1 < size || circular ? int(after) : -1);
      if (k + 1 < size) graph.edges.push_back({n + k, n + k + 1});
      graph.points.push_back({*any_finite(), *any_finite(), *any_finite(), 0});
    }
    if (circular) graph.edges.push_back({n, n + size - 1});
    n += size;
  }
  std::ranges::sort(graph.edges);
  const std::string configuration = configuration_of(graph.points, 2);
  for (const std::string& top :
       {fmt::format("{} {}\n", n, strands) + old_rows, fmt::format("{} {} 5->3\n", n, strands) + new_rows}) {
    const CurveFile curves = read_oxdna(top, configuration);
    is_the_graph(curves, graph, 0, false, true);
    RC_ASSERT(curves.later_frames.size() == 1u);
    RC_ASSERT(curves.boxes == std::vector<PeriodicBox>(2, PeriodicBox{{20, 30, 40}}));
    RC_ASSERT(curves.joints.empty());
  }
}

TEST(OxdnaReader, CountsABaseInBracketsOnce) {
  EXPECT_EQ(read_oxdna("3 1 5->3\nA(12)G\n", configuration_of(std::vector<Sphere>(3), 1)).strand_first,
            (std::vector<std::uint32_t>{0, 3}));
}

TEST(OxdnaReader, SaysWhatIsWrong) {
  EXPECT_COMPLAINT(" the strands are in oxDNA's topology; name it with --topology", "a.conf", "t = 0\n");
  const std::string top = "2 1\n1 A -1 1\n1 C 0 -1\n", rows = "0 0 0\n1 0 0\n";
  EXPECT_THROW(read_oxdna("2 1\n1 A -1 1\n", "t = 0\nb = 1 1 1\n" + rows), InputError);
  for (const char* neighbour : {"9", "2", "-2"})
    EXPECT_THROW(
        read_oxdna(fmt::format("2 1\n1 A -1 {}\n1 C 0 -1\n", neighbour), "t = 0\nb = 1 1 1\n" + rows),
        InputError);
  EXPECT_THROW(read_oxdna(top, "t = 0\nb = 1 1 1\n" + rows + "t = 1\n" + rows), InputError);
  EXPECT_THROW(read_oxdna(top, "t = 0\n" + rows), InputError);
  EXPECT_THROW(read_oxdna(top, "\xEF\xBB\xBF"), InputError);  // a mark and nothing else, found by libFuzzer
  EXPECT_THROW(read_oxdna(top, "t = 0\nb = 1 1 1\n0 0 0\n"), InputError);
  EXPECT_THROW(read_oxdna(top, "t = 0\nb = 1 1 1\n" + rows + "2 0 0\n"), InputError);
  EXPECT_EQ(read_oxdna(top, "t = 0\nb = 1 1 1\n" + rows).spheres.size(), 2u);
}

TEST(Beads, RefuseWhatTheirNeighboursContradict) {
  EXPECT_COMPLAINT("13: a bond ties atom 1 to itself", "a.data",
                   "t\n\n2 atoms\n1 bonds\n\nAtoms # bond\n\n1 1 1 0 0 0\n2 1 1 1 0 0\n\nBonds\n\n1 1 1 1\n");
  const auto topology = [](const std::string& text) {
    const TestFile top("a.top", text), file("a.conf", "t = 0\nb = 9 9 9\nE = 0\n0 0 0\n1 0 0\n2 0 0\n");
    try {
      ReaderRegistry::instance().read(file.path(), {.topology = top.path().string()});
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(topology("3 1\n1 A -1 1\n1 C 0 2\n1 G 1 -1\n"), "");
  for (const char* none : {"3", "-2"})
    EXPECT_NE(topology(fmt::format("3 1\n1 A -1 {}\n1 C 0 2\n1 G 1 -1\n", none))
                  .find(fmt::format("neighbour {} is not one of 3 nucleotides", none)),
              std::string::npos);
  EXPECT_NE(topology("3 1\n1 A -1 2\n1 C 0 2\n1 G 1 -1\n").find("has the neighbour"), std::string::npos);
  EXPECT_NE(topology("3 1\n1 A -1 0\n1 C -1 2\n1 G 1 -1\n").find("nucleotide 0 "), std::string::npos);
  EXPECT_COMPLAINT("3: bin 4 of 'chr1' comes after 4", "a.nucle3d", "CHR\tchr1\n4,0,0,0\n4,1,0,0\n");
}

}  // namespace
}  // namespace catena
