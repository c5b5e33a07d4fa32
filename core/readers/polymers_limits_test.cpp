#include <fmt/format.h>

#include "catena/core/readers/test_file.h"

/// Where tables of mmCIF end, and which atoms of either format are one residue.
namespace catena {
namespace {

const std::string columns =
    "data_a\nloop_\n_atom_site.group_PDB\n_atom_site.label_atom_id\n_atom_site.label_alt_id\n_atom_site."
    "label_comp_id\n"
    "_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site."
    "Cartn_z\n"
    "_atom_site.occupancy\n";
std::string atom(double x, const std::string& group = "ATOM", const std::string& residue = "ALA 1 A",
                 const std::string& alternate = ".", const std::string& occupancy = "1.0") {
  const std::string name = residue.substr(0, 3), number = residue.substr(4, 1), chain = residue.substr(6);
  return fmt::format("{} CA {} {} {} {} {} 0 0 {}\n", group, alternate, name, chain, number, x, occupancy);
}
std::vector<float> xs(const CurveFile& curves) {
  std::vector<float> all;
  for (const Sphere& sphere : curves.spheres) all.push_back(sphere.x);
  return all;
}

TEST(MmcifReader, KnowsWhereItsTableEnds) {
  for (const std::string next : {"_cell.length_b 2\n", "data_b\n", "loop_\n_cell.x\n5\n", "# that is all\n"})
    EXPECT_EQ(xs(read_text("a.cif", columns + atom(1) + next)), std::vector<float>{1}) << next;
  EXPECT_EQ(
      xs(read_text("a.cif", "data_a\nloop_\n_atom_site_anisotrop.id\n_atom_site_anisotrop.type\n1 C\n#\n" +
                                columns.substr(7) + atom(1) + "#\n")),
      std::vector<float>{1})
      << "of another category whose name begins alike";
  EXPECT_NE(complaint("a.cif", columns + "ATOM CA\n;\nALA\n;\n")
                .find("a text of several lines where a word is due"),
            std::string::npos);
}

/// An occupancy that is not known is that of an atom which is there.
TEST(MmcifReader, TakesAnUnknownOccupancyForAWholeOne) {
  for (const char* unknown : {"?", "."})
    EXPECT_EQ(xs(read_text("a.cif", columns + atom(1, "ATOM", "ALA 1 A", "A", "0.6") +
                                        atom(2, "ATOM", "ALA 1 A", "B", unknown))),
              std::vector<float>{2});
}

TEST(MmcifReader, TakesResiduesOfThePolymersSequence) {
  const std::string atoms = columns + atom(0) + atom(3, "HETATM", "XYZ 2 A") + "#\n";
  EXPECT_EQ(xs(read_text("a.cif", atoms)), std::vector<float>{0});
  EXPECT_EQ(
      xs(read_text("a.cif",
                   atoms + "loop_\n_entity_poly_seq.entity_id\n_entity_poly_seq.mon_id\n1 ALA\n1 XYZ\n#\n")),
      (std::vector<float>{0, 3}));
}

std::string line(const char* name, char alternate, char chain, int number, char insertion, double x,
                 const char* segment = "") {
  return fmt::format("ATOM      1 {:<4}{}GLY {}{:>4}{}   {:8.3f}{:8.3f}{:8.3f}{:6.2f}{:6.2f}      {:<4}\n",
                     name, alternate, chain, number, insertion, x, 0.0, 0.0, 1.0, 9.0, segment);
}

TEST(PdbReader, BreaksNucleicAcidsWhereASextupleOfBondsDoesNotReach) {
  EXPECT_EQ(
      read_text("a.pdb", line(" P  ", ' ', 'A', 1, ' ', 0) + line(" P  ", ' ', 'A', 2, ' ', 8)).strand_first,
      (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(read_text("a.pdb", line(" P  ", ' ', 'A', 1, ' ', 0) + line(" P  ", ' ', 'A', 2, ' ', 8.001))
                .strand_first,
            (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(PdbReader, NamesResiduesByInsertionAndSegmentToo) {
  const CurveFile curves = read_text("a.pdb", line(" CA ", ' ', ' ', 1, ' ', 0, "PROA") +
                                                  line(" CA ", ' ', ' ', 1, 'B', 3, "PROA") +
                                                  line(" CA ", ' ', ' ', 1, ' ', 9, "PROB"));
  EXPECT_EQ(curves.labels.of(0), "PROA/GLY1/CA");
  EXPECT_EQ(curves.labels.of(1), "PROA/GLY1B/CA");
  EXPECT_EQ(curves.labels.of(2), "PROB/GLY1/CA");
  EXPECT_EQ(curves.labels.strand_names, (std::vector<std::string>{"PROA", "PROB"}));
}

/// One of each of two alternatives is one residue; the same one twice are two.
TEST(PdbReader, TakesAnAlternativeThatComesTwiceForAnotherResidue) {
  EXPECT_EQ(xs(read_text("a.pdb", line(" CA ", 'A', 'A', 1, ' ', 0) + line(" CA ", 'B', 'A', 1, ' ', 1))),
            std::vector<float>{0});
  EXPECT_EQ(xs(read_text("a.pdb", line(" CA ", 'A', 'A', 1, ' ', 0) + line(" CA ", 'A', 'A', 1, ' ', 1))),
            (std::vector<float>{0, 1}));
}

}  // namespace
}  // namespace catena
