#include <fmt/format.h>
#include <zlib.h>

#include "catena/core/readers/test_file.h"

/// What files of simulations may leave out or add, and what is refused of them with a reason.
namespace catena {
namespace {

void expect_says(const std::string& said, const std::string& words) {
  EXPECT_NE(said.find(words), std::string::npos) << "got '" << said << "' instead of '" << words << "'";
}

TEST(LammpsDataReader, RefusesBondsThatNobodyCanPlace) {
  const std::string header = "t\n\n3 atoms\n1 bonds\n\n",
                    atoms = "Atoms # bond\n\n1 1 1 0 0 0\n2 1 1 1 0 0\n4 1 1 2 0 0\n\n";
  expect_says(complaint("a.data", header + "Bonds\n\n1 1 1 2\n\n" + atoms),
              "the bonds come before the atoms");
  expect_says(complaint("a.data", header + atoms + "Bonds\n\n1 1 2\n"),
              "a bond is 'id type atom atom', got 3 columns");
  expect_says(complaint("a.data", header + atoms + "Bonds\n\n1 1 2 3\n"),
              "a bond names atom 3, which is not there");
  EXPECT_EQ(read_text("a.data", header + atoms + "Bonds\n\n1 1 4 2\n").strand_first,
            (std::vector<std::uint32_t>{0, 2, 3}));
}

std::string dump(const std::string& bounds, const std::string& columns, const std::string& rows) {
  return fmt::format("ITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}ITEM: ATOMS {}\n{}",
                     std::ranges::count(rows, '\n'), bounds, columns, rows);
}
const std::string cube = "pp pp pp\n0 8\n0 8\n0 8\n";

TEST(LammpsDumpReader, TakesFractionsThatAreUnwrapped) {
  EXPECT_EQ(read_text("a.dump", dump(cube, "id xsu ysu zsu", "1 1.5 -0.5 0.25\n")).spheres,
            (std::vector<Sphere>{{12, -4, 2, 0}}));
}

TEST(LammpsDumpReader, TiesMoleculesThatItNames) {
  EXPECT_EQ(read_text("a.dump", dump(cube, "id mol x y z", "1 7 0 0 0\n2 7 1 0 0\n3 5 2 0 0\n4 5 3 0 0\n"))
                .strand_first,
            (std::vector<std::uint32_t>{0, 2, 4}));
}

TEST(LammpsDumpReader, RefusesRowsThatAreNotWhatTheirNamesSay) {
  expect_says(complaint("a.dump", dump(cube, "id x y z", "1 0 0 0 5\n")),
              "an atom of 5 columns, but 4 are named");
  expect_says(complaint("a.dump", dump(cube, "id x y", "1 0 0\n")), "the columns lack id, or x y z");
  expect_says(complaint("a.dump", dump("xy xz yz pp pp pp\n0 8 0\n0 8\n0 8 0\n", "id x y z", "1 0 0 0\n")),
              "a bound of the box is 'low high', and a tilt where it is tilted");
}

/// What a column says twice, or a radius and a diameter, may be read in two ways; what is not read may be.
TEST(LammpsDumpReader, RefusesColumnsThatSayOneThingTwice) {
  for (const char* name : {"id", "mol", "x", "radius"})
    expect_says(
        complaint("a.dump", dump(cube, std::string("id mol x y z radius ") + name, "1 1 0 0 0 1 1\n")),
        std::string("the column ") + name + " comes twice");
  for (const char* columns : {"id x y z radius diameter", "id radius diameter x y z"})
    expect_says(complaint("a.dump", dump(cube, columns, "1 1 1 1 2 1\n")), "is not half of the diameter");
  EXPECT_EQ(read_text("a.dump", dump(cube, "id x y z q q", "1 0 0 0 1 2\n")).spheres.size(), 1u);
}

/// Strands are those of the first frame: where they are molecules, these are the same in all frames.
TEST(LammpsDumpReader, RefusesMoleculesThatChange) {
  const auto frame = [](const std::string& columns, const std::string& rows) {
    return "ITEM: TIMESTEP\n7\n" + dump(cube, columns, rows);
  };
  const std::string named = "id mol x y z", first = frame(named, "1 1 0 0 0\n2 1 1 0 0\n3 2 2 0 0\n");
  EXPECT_EQ(
      read_text("a.dump", first + frame(named, "3 2 2 0 0\n1 1 0 0 0\n2 1 1 0 0\n")).later_frames.size(), 1u);
  const std::string others = first + first + frame(named, "3 2 2 0 0\n1 1 0 0 0\n2 2 1 0 0\n");
  expect_says(complaint("a.dump", others), "atom 2 is of molecule 2 in frame 2, of 1 in frame 0");
  expect_says(complaint("a.dump", first + frame("id x y z", "1 0 0 0\n2 1 0 0\n3 2 0 0\n")),
              "atom 1 is of molecule 0 in frame 1, of 1 in frame 0");
  expect_says(complaint("a.dump", frame("id x y z", "1 0 0 0\n") + frame(named, "1 5 0 0 0\n")),
              "atom 1 is of molecule 5 in frame 1, of 0 in frame 0");
  const TestFile bonds("b.data", "t\n\n3 atoms\n1 bonds\n\nBonds\n\n1 1 1 3\n"), dumped("a.dump", others);
  EXPECT_EQ(ReaderRegistry::instance().read(dumped.path(), {.topology = bonds.path().string()}).strand_first,
            (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(LammpsDataReader, RefusesAHeaderThatSaysOneThingTwice) {
  const std::string atoms = "\nAtoms # atomic\n\n1 1 0 0 0\n",
                    box = "0 8 xlo xhi\n0 8 ylo yhi\n0 8 zlo zhi\n";
  EXPECT_EQ(read_text("a.data", "t\n\n1 atoms\n" + box + atoms).boxes.size(), 1u);
  for (const std::string line : {"1 atoms", "0 bonds", "0 9 xlo xhi", "0 9 zlo zhi", "0 0 0 xy xz yz"})
    expect_says(complaint("a.data", "t\n\n1 atoms\n0 bonds\n0 0 0 xy xz yz\n" + box + line + "\n" + atoms),
                "the header says " + line.substr(line.find_first_not_of("0123456789 ")) + " twice");
}

TEST(LammpsDataReader, SaysThatABoxOfAnyEdgesIsLeftOut) {
  const CurveFile curves = read_text("a.data",
                                     "t\n\n1 atoms\n8 0 0 avec\n0 8 0 bvec\n0 0 8 cvec\n0 0 0 abc origin\n\n"
                                     "Atoms # atomic\n\n1 1 0 0 0\n");
  EXPECT_TRUE(curves.boxes.empty());
  ASSERT_FALSE(curves.warnings.empty());
  expect_says(curves.warnings[0], "its box of general edges (avec bvec cvec) is left out");
}

/// A frame is whole or refused: wherever its header ends, and whether the file or another frame follows.
TEST(LammpsDumpReader, RefusesFramesOfWhichTheAtomsAreMissing) {
  const std::string units = "ITEM: UNITS\nlj\nITEM: TIME\n0.5\n", step = "ITEM: TIMESTEP\n7\n",
                    whole = step + dump(cube, "id x y z", "1 0 0 0\n2 1 0 0\n");
  EXPECT_EQ(read_text("a.dump", units + whole + "\n" + whole).later_frames.size(), 1u);
  const std::size_t atoms = whole.find("ITEM: ATOMS");
  for (std::size_t end = 1; end < atoms; ++end) {
    if (whole[end - 1] != '\n') continue;
    EXPECT_NE(complaint("a.dump", whole + whole.substr(0, end)), "") << end;
    EXPECT_NE(complaint("a.dump", whole + whole.substr(0, end) + whole), "") << end;
  }
  expect_says(complaint("a.dump", whole + step),
              "13: the file is truncated: it ends where 'ITEM: ATOMS' is due");
  expect_says(complaint("a.dump", whole + step + whole), "14: another frame begins where 'ITEM: ATOMS'");
}

TEST(LammpsDumpReader, RefusesFramesWithoutTheBoxThatTheyNeed) {
  const auto no_box = [](const std::string& columns) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS " + columns + "\n1 0.5 0.5 0.5\n";
  };
  const std::string boxed = dump(cube, "id xs ys zs", "1 0.5 0.5 0.5\n"),
                    open = dump("ff ff ff\n0 8\n0 8\n0 8\n", "id xs ys zs", "1 0.5 0.5 0.5\n");
  EXPECT_EQ(read_text("a.dump", no_box("id x y z")).spheres, (std::vector<Sphere>{{0.5, 0.5, 0.5, 0}}));
  const std::string missing = "scaled coordinates need their box; the frame has no 'ITEM: BOX BOUNDS'",
                    unlike = "this frame and the first differ in having a periodic box";
  expect_says(complaint("a.dump", no_box("id xs ys zs")), "5: " + missing);
  expect_says(complaint("a.dump", boxed + no_box("id xs ys zs")), "13: " + missing);
  expect_says(complaint("a.dump", boxed + no_box("id x y z")), "13: " + unlike);
  expect_says(complaint("a.dump", boxed + open), "15: " + unlike);
  expect_says(complaint("a.dump", open + boxed), "15: " + unlike);
}

/// A topology is checked as a data file is, and named where it is wrong.
TEST(LammpsDumpReader, RefusesATopologyThatIsNoneOrNotWhole) {
  const auto said = [](const std::string& topology) -> std::string {
    const TestFile data("b.data", topology), file("a.dump", dump(cube, "id x y z", "1 0 0 0\n2 1 0 0\n"));
    try {
      ReaderRegistry::instance().read(file.path(), {.topology = data.path().string()});
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const std::string bonds = "\nBonds\n\n1 1 1 2\n", none = "no LAMMPS data with a section Bonds; name one";
  EXPECT_EQ(said("t\n\n1 bonds\n" + bonds), "");
  expect_says(said("t\n\n4 bonds\n" + bonds), "b.data:7: the header says 4 bonds, the file has 1");
  expect_says(said("t\n\n4 bonds\n"), "b.data:3: the header says 4 bonds, the file has 0");
  expect_says(said("t\n\n1 bonds\n" + bonds + "2 1 2 1\n"),
              "b.data:8: the header says 1 bond, the file has 2");
  expect_says(said("t\n\n2 atoms\n\nAtoms # bond\n\n1 1 1 0 0 0\n2 1 1 0 0 0\n"), none);
  expect_says(said("The bonds of a melt, in prose.\n"), none);
  expect_says(said(dump(cube, "id x y z", "1 0 0 0\n")), none);
  expect_says(said("t\n\n1 bonds\n\nBonds\n\n1 1 1 8\n"),
              "b.data:7: a bond names atom 8, which is not there");
}

/// What is no bond in the file that names them.
TEST(LammpsDumpReader, TakesNothingButTheBondsOfItsTopology) {
  const TestFile data(
      "b.data",
      "t\n\n3 atoms\n1 bonds\n\nMasses\n\n1 12 1 2\n\nAtoms # bond\n\n1 1 1 0 0 0\n2 1 1 0 0 0\n3 1 1 0 0 "
      "0\n\nBonds\n\n1 1 1 2\n\nAngles\n\n1 1 3 2 1\n"),
      file("a.dump", dump(cube, "id x y z", "1 0 0 0\n2 1 0 0\n3 2 0 0\n"));
  EXPECT_EQ(ReaderRegistry::instance().read(file.path(), {.topology = data.path().string()}).strand_first,
            (std::vector<std::uint32_t>{0, 2, 3}));
}

std::string oxdna_complaint(const std::string& topology, const std::string& configuration) {
  const TestFile top("a.top", topology), file("a.conf", configuration);
  try {
    ReaderRegistry::instance().read(file.path(), {.topology = top.path().string()});
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(OxdnaReader, RefusesFramesThatAreNotWhole) {
  const std::string top = "2 1\n1 A -1 1\n1 C 0 -1\n", rows = "0 0 0\n1 0 0\n", box = "b = 9 9 9\n";
  EXPECT_EQ(oxdna_complaint(top, "t = 0\n" + box + rows), "");
  expect_says(oxdna_complaint(top, "t = 0\n" + box + "t = 1\n" + box + rows),
              "frame 0 has 0 nucleotides, the topology 2");
  EXPECT_EQ(oxdna_complaint(top, "t = 0\n" + box + rows + "t = 1\nb = 8 9 9\n" + rows), "");
  expect_says(oxdna_complaint(top, "t = 0\n" + box + rows + "t = 1\nb = 0 0 0\n" + rows),
              "a.conf:6: this frame and the first differ in having a periodic box");
  expect_says(oxdna_complaint(top, "t = 0\nb = 9 9 9 9\n" + rows), "the box is 'b = X Y Z'");
  expect_says(oxdna_complaint(top, "t = 0\n" + box + box + rows), "a.conf:3: a second box of this frame");
  expect_says(oxdna_complaint(top, "t = 0\n" + box + rows + "2 0 0\n"),
              "frame 0 has more nucleotides than the topology's 2");
  expect_says(oxdna_complaint("2 1\n1 A 0 0\n1 C -1 -1\n", "t = 0\n" + box + rows),
              "nucleotide 0 is its own neighbour");
}

TEST(OxdnaReader, ClosesStrandsThatSayTheyAreCircular) {
  const std::string conf = "t = 0\nb = 9 9 9\n0 0 0\n1 0 0\n2 0 0\n";
  const auto topology = [](const std::string& said) {
    return fmt::format("3 1 5->3\nACG type=DNA {}\n", said);
  };
  for (const auto& [closed, words] : std::vector<std::pair<std::uint8_t, std::vector<std::string>>>{
           {1, {"circular=1", "circular=true", "Circular=True", "circular=yes", "circular=YUP"}},
           {0, {"circular=0", "circular=False", "circular=no", "circular=nope", "circularity=9", ""}}})
    for (const std::string& said : words) {
      const TestFile top("a.top", topology(said)), file("a.conf", conf);
      EXPECT_EQ(ReaderRegistry::instance().read(file.path(), {.topology = top.path().string()}).strand_closed,
                std::vector<std::uint8_t>{closed})
          << said;
    }
  for (const char* neither : {"circular=", "circular", "circular=2", "circular=tru"})
    expect_says(oxdna_complaint(topology(neither), conf),
                "a.top:2: '" + std::string(neither) + "': a strand is circular=true or circular=false");
}

/// a.top beside a.conf.gz.
TEST(OxdnaReader, FindsTheTopologyBesideAPackedFile) {
  const TestFile file("a.conf.gz", "");
  const gzFile packed = gzopen(file.path().c_str(), "wb");
  gzputs(packed, "t = 0\nb = 9 9 9\n0 0 0\n1 0 0\n");
  gzclose(packed);
  std::ofstream(file.path().parent_path() / "a.top") << "2 1\n1 A -1 1\n1 C 0 -1\n";
  EXPECT_EQ(ReaderRegistry::instance().read(file.path()).spheres.size(), 2u);
}

}  // namespace
}  // namespace catena
