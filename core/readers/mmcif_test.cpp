#include <fmt/format.h>

#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"

namespace catena {
namespace {

/// The same residues in both formats: name, chain, number, model, and whether it is HETATM.
struct Atom {
  const char *group, *name, *residue;
  char chain;
  int number, model;
  double x, y, z;
};

std::string cif_of(const std::vector<Atom>& atoms, bool quoted, bool split) {
  std::string text =
      "data_a\n_cell.length_a "
      "1\nloop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_"
      "alt_id\n"
      "_atom_site.auth_comp_id\n_atom_site.label_asym_id\n_atom_site.auth_asym_id\n_atom_site.auth_seq_id\n_"
      "atom_site.pdbx_PDB_ins_code\n"
      "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.occupancy\n_atom_site.pdbx_PDB_"
      "model_num\n";
  for (const Atom& a : atoms)
    text += fmt::format("{} C {}{}{} . {} {} {} {} ?{}{:.3f} {:.3f} {:.3f} 1.0 {}\n", a.group,
                        quoted ? "'" : "", a.name, quoted ? "'" : "", a.residue, a.chain, a.chain, a.number,
                        split ? "\n" : " ", a.x, a.y, a.z, a.model);
  return text + "#\n";
}

std::string pdb_of(const std::vector<Atom>& atoms) {
  std::string text;
  int serial = 0;
  for (std::size_t k = 0; k < atoms.size(); ++k) {
    const Atom& a = atoms[k];
    if (k == 0 || a.model != atoms[k - 1].model)
      text += (k > 0 ? "ENDMDL\n" : "") + fmt::format("MODEL     {:4}\n", a.model);
    if (k > 0 && a.model == atoms[k - 1].model && a.chain != atoms[k - 1].chain) text += "TER\n";
    text += fmt::format("{:<6}{:5}  {:<3} {:<3} {}{:4}    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           C\n",
                        a.group, ++serial, a.name, a.residue, a.chain, a.number, a.x, a.y, a.z);
  }
  return text + "ENDMDL\nEND\n";
}

// What a .pdb file gives, the same atoms give as mmCIF.
RC_GTEST_PROP(MmcifReader, GivesWhatPdbGives, (bool quoted, bool split)) {
  std::vector<Atom> atoms;
  const auto chains = *rc::gen::inRange(1, 4), length = *rc::gen::inRange(1, 6),
             models = *rc::gen::inRange(1, 3);
  for (int model = 1; model <= models; ++model)
    for (int c = 0; c < chains; ++c)
      for (int r = 0; r < length; ++r) {
        const bool gap = r == 3;
        const double x = 3.8 * r + (gap ? 9 : 0) + *rc::gen::inRange(0, 100) / 1000.0;
        atoms.push_back({"ATOM", "N", "ALA", static_cast<char>('A' + c), r + 1, model, x - 1, c * 10.0, 0.5});
        atoms.push_back(
            {"ATOM", "CA", "ALA", static_cast<char>('A' + c), r + 1, model, x, c * 10.0, model * 1.5});
      }
  const CurveFile cif = read_text("a.cif", cif_of(atoms, quoted, split)),
                  pdb = read_text("a.pdb", pdb_of(atoms));
  RC_ASSERT(cif.spheres.size() == std::size_t(chains) * length);
  RC_ASSERT(cif.spheres == pdb.spheres);
  RC_ASSERT(cif.later_frames == pdb.later_frames);
  RC_ASSERT(cif.strand_first == pdb.strand_first);
  RC_ASSERT(cif.labels.strand_names == pdb.labels.strand_names);
  for (std::uint32_t i = 0; i < cif.spheres.size(); ++i) RC_ASSERT(cif.labels.of(i) == pdb.labels.of(i));
}

// As after TER: what is of the same chain by its author's name, but of another label, comes after its end.
TEST(MmcifReader, LeavesLigandsOfAnotherLabelOut) {
  std::string text = cif_of(
      {{"ATOM", "CA", "ALA", 'A', 1, 1, 0, 0, 0}, {"HETATM", "CA", "MSE", 'A', 2, 1, 3, 0, 0}}, false, false);
  EXPECT_EQ(read_text("a.cif", text).spheres.size(), 2u);
  text.replace(text.find("MSE A A"), 7, "MSE B A");
  EXPECT_EQ(read_text("a.cif", text).spheres.size(), 1u);
}

// What the authors call a thing goes before the archive's name of it, and is done without where it is not
// there.
TEST(MmcifReader, NamesThingsAsTheirAuthorsDo) {
  const std::vector<std::string> names{"atom_id", "comp_id", "asym_id", "seq_id"};
  const std::vector<std::string> of_authors{"CA", "ALA", "X", "7"}, of_archive{"CB", "GLY", "Y", "9"};
  const auto label = [&](const std::string& left_out, bool labels_first) {
    std::string heading = "data_a\nloop_\n_atom_site.group_PDB\n", row = "ATOM";
    for (const bool author : {!labels_first, labels_first})
      for (std::size_t k = 0; k < names.size(); ++k) {
        const std::string name = (author ? "auth_" : "label_") + names[k];
        if (name == left_out) continue;
        heading += "_atom_site." + name + "\n", row += " " + (author ? of_authors : of_archive)[k];
      }
    for (const char* axis : {"x", "y", "z"}) heading += "_atom_site.Cartn_" + std::string(axis) + "\n";
    const TestFile file("a.cif", heading + row + " 1 2 3\n");
    const CurveFile curves =
        ReaderRegistry::instance().read(file.path(), {.atom = left_out == "auth_atom_id" ? "CB" : "CA"});
    return curves.spheres.size() == 1 ? curves.labels.of(0) : "";
  };
  for (const bool labels_first : {false, true}) {
    EXPECT_EQ(label("", labels_first), "X/ALA7/CA");
    for (std::size_t k = 0; k < names.size(); ++k)
      EXPECT_EQ(label("label_" + names[k], labels_first), "X/ALA7/CA") << names[k];
    EXPECT_EQ(label("auth_atom_id", labels_first), "X/ALA7/CB");
    EXPECT_EQ(label("auth_comp_id", labels_first), "X/GLY7/CA");
    EXPECT_EQ(label("auth_asym_id", labels_first), "Y/ALA7/CA");
    EXPECT_EQ(label("auth_seq_id", labels_first), "X/ALA9/CA");
  }
}

// As in a .pdb file, where no TER is there; a residue of the polymer that is a HETATM goes on, too.
TEST(MmcifReader, GoesOnBehindALigandWithinAChain) {
  for (const char* group : {"ATOM", "HETATM"}) {
    const std::vector<Atom> atoms{
        {"ATOM", "CA", "ALA", 'A', 1, 1, 0, 0, 0},   {"HETATM", "C1", "NAG", 'A', 901, 1, 1, 5, 0},
        {"ATOM", "CA", "ALA", 'A', 2, 1, 3.8, 0, 0}, {"HETATM", "CA", "MSE", 'A', 902, 1, 9, 5, 0},
        {group, "CA", "MSE", 'A', 3, 1, 7.6, 0, 0},  {"ATOM", "CA", "ALA", 'B', 1, 1, 7.6, 3, 0}};
    std::string text = cif_of(atoms, false, false);
    text.replace(text.find("NAG A A"), 7, "NAG C A");
    text.replace(text.find("MSE A A"), 7, "MSE D A");
    const CurveFile curves = read_text("a.cif", text);
    EXPECT_EQ(curves.spheres,
              (std::vector<Sphere>{{0, 0, 0, 0}, {3.8f, 0, 0, 0}, {7.6f, 0, 0, 0}, {7.6f, 3, 0, 0}}));
    EXPECT_EQ(curves.strand_first, (std::vector<std::uint32_t>{0, 3, 4})) << group;
  }
}

// Numbers used twice, without alternatives, are two residues, as in a .pdb file.
TEST(MmcifReader, TakesNumbersUsedTwiceForTwoResidues) {
  const std::vector<Atom> atoms{{"ATOM", "CA", "SER", 'A', 1, 1, 0, 0, 0},
                                {"ATOM", "CA", "THR", 'A', 1, 1, 3, 0, 0}};
  const CurveFile cif = read_text("a.cif", cif_of(atoms, false, false)),
                  pdb = read_text("a.pdb", pdb_of(atoms));
  EXPECT_EQ(cif.spheres.size(), 2u);
  EXPECT_EQ(cif.spheres, pdb.spheres);
}

// A quote before something else than a blank is part of the word.
TEST(MmcifReader, TakesAQuoteWithinAQuotedWord) {
  std::string text = cif_of({{"ATOM", "P", "A", 'A', 1, 1, 0, 0, 0}}, true, false);
  text.replace(text.find("'P'"), 3, "'O5'P'");
  const TestFile file("a.cif", text);
  EXPECT_EQ(ReaderRegistry::instance().read(file.path(), {.atom = "O5'P"}).spheres.size(), 1u);
}

TEST(MmcifReader, SaysThatASecondTableIsNotRead) {
  const std::string atoms = cif_of({{"ATOM", "CA", "ALA", 'A', 1, 1, 0, 0, 0}}, false, false),
                    table = atoms.substr(atoms.find("loop_"));
  for (const std::string between : {"", "data_b\n", "loop_\n_other.id\n1\n"}) {
    const std::string first = atoms.substr(0, atoms.size() - 2);  // without its #
    const CurveFile curves = read_text("a.cif", first + between + table);
    EXPECT_EQ(curves.spheres.size(), 1u);
    ASSERT_EQ(curves.warnings.size(), 1u) << between;
    EXPECT_NE(curves.warnings[0].find("a second table _atom_site is not read"), std::string::npos);
  }
  std::string twice = atoms;
  twice.replace(twice.find("Cartn_y"), 7, "Cartn_x");
  EXPECT_NE(complaint("a.cif", twice).find("the column Cartn_x comes twice"), std::string::npos);
}

TEST(MmcifReader, SkipsTextsOfSeveralLines) {
  const std::string atoms = cif_of({{"ATOM", "CA", "ALA", 'A', 1, 1, 0, 0, 0}}, false, false);
  EXPECT_EQ(read_text("a.cif", "data_a\n_struct.title\n;a title\nof lines\nloop_\n_atom_site.fake\n;\n" +
                                   atoms.substr(7))
                .spheres.size(),
            1u);
}

TEST(MmcifReader, TakesNamesAndKeywordsOfAnyCase) {
  std::string text = cif_of({{"ATOM", "CA", "ALA", 'A', 1, 1, 1, 2, 3}}, false, false);
  text.replace(text.find("loop_"), 5, "LOOP_");
  text.replace(text.find("_atom_site.Cartn_x"), 18, "_Atom_Site.cartn_X");
  EXPECT_EQ(read_text("a.cif", text).spheres, (std::vector<Sphere>{{1, 2, 3, 0}}));
}

TEST(MmcifReader, SaysThatItDoesNotReadASecondBlock) {
  const std::string block = cif_of({{"ATOM", "CA", "ALA", 'A', 1, 1, 1, 2, 3}}, false, false);
  EXPECT_EQ(read_text("a.cif", block + block).warnings,
            (std::vector<std::string>{"line 37: a second table _atom_site is not read"}));
}

// Longer than what is given back of the text while it is read.
TEST(MmcifReader, ReadsLongFilesWhoseRowsTakeTwoLines) {
  std::vector<Atom> atoms;
  for (int k = 0; k < 200000; ++k) atoms.push_back({"ATOM", "CA", "ALA", 'A', k, 1, 3.8 * (k % 9), 0, 0});
  const std::string text = cif_of(atoms, false, true);
  ASSERT_GT(text.size(), std::size_t{8} << 20);
  const CurveFile curves = read_text("a.cif", text);
  ASSERT_EQ(curves.spheres.size(), atoms.size());
  for (std::uint32_t k = 0; k < atoms.size(); ++k) {
    ASSERT_EQ(curves.spheres[k].x, static_cast<float>(std::stod(fmt::format("{:.3f}", atoms[k].x))));
    ASSERT_EQ(curves.labels.of(k), fmt::format("A/ALA{}/CA", k));
  }
}

TEST(MmcifReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("1: the file has no table _atom_site", "a.cif", "data_a\n");
  EXPECT_COMPLAINT("3: the table _atom_site has no column group_PDB", "a.cif", "loop_\n_atom_site.id\n1\n");
  const std::string whole = cif_of({{"ATOM", "CA", "ALA", 'A', 1, 1, 0, 0, 0}}, false, false);
  EXPECT_COMPLAINT("18: the row has 13 words, the table 14 columns", "a.cif",
                   whole.substr(0, whole.size() - 5));
  std::string bad = whole;
  bad.replace(bad.find("0.000"), 5, "x.000");
  EXPECT_COMPLAINT("18: Cartn_x 'x.000' is not a number", "a.cif", bad);
  bad = whole;
  bad.replace(bad.find(" CA "), 4, " 'CA ");
  EXPECT_COMPLAINT("18: a quote is not closed", "a.cif", bad);
}

}  // namespace
}  // namespace catena
