#include <fmt/format.h>

#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

using Offsets = std::vector<std::uint32_t>;

struct Atom {
  float x;
  const char* record = "ATOM";
  const char* name = " CA ";
  char alternate = ' ';
  const char* residue = "GLY";
  char chain = 'A';
  int number = 1;
  double occupancy = 1;
};

std::string line(const Atom& a) {
  return fmt::format("{:<6}{:>5} {}{}{:>3} {}{:>4}    {:8.3f}{:8.3f}{:8.3f}{:6.2f}{:6.2f}\n", a.record, 1,
                     a.name, a.alternate, a.residue, a.chain, a.number, a.x, 0.0, 0.0, a.occupancy, 9.0);
}

std::string lines(const std::vector<Atom>& atoms) {
  std::string text;
  for (const Atom& atom : atoms) text += line(atom);
  return text;
}

std::vector<float> xs(const CurveFile& curves) {
  std::vector<float> all;
  for (const Sphere& sphere : curves.spheres) all.push_back(sphere.x);
  return all;
}

CurveFile read_atom(const char* atom, const std::string& text) {
  const TestFile file("a.pdb", text);
  return ReaderRegistry::instance().read(file.path(), {.atom = atom});
}

TEST(PdbReader, TakesCAlphasByColumns) {
  const CurveFile curves = read_text("a.pdb", lines({{0},
                                                     {1, "ATOM", " N  "},
                                                     {2, "HETATM", "CA  ", ' ', " CA"},  // calcium
                                                     {3, "ATOM", " CA ", 'A', "GLY", 'A', 2},
                                                     {3.5, "ATOM", " CA ", 'B', "GLY", 'A', 2},
                                                     {6, "HETATM", " CA ", ' ', "MSE", 'A', 3},
                                                     {7, "HETATM", " CA ", ' ', "LIG", 'A', 4}}) +
                                                  "END\n");
  EXPECT_EQ(curves.strand_first, (Offsets{0, 3}));
  EXPECT_EQ(xs(curves), (std::vector<float>{0, 3, 6}));
  EXPECT_EQ(curves.labels.of(2), "A/MSE3/CA");
  EXPECT_FALSE(curves.has_radii);
  ASSERT_EQ(curves.warnings.size(), 1u);
  EXPECT_EQ(curves.warnings[0], "1 HETATM residue is left out, as it is not of a chain: A/LIG4");
}

TEST(PdbReader, TakesModifiedResiduesWithoutSeqresByTheirBackbone) {
  std::vector<Atom> atoms;
  for (int r = 0; r < 4; ++r)
    for (const char* name : {" N  ", " CA ", " C  "})
      atoms.push_back({static_cast<float>(3 * r), "HETATM", name, ' ', r % 2 ? "DAL" : "MVA", 'A', r});
  const CurveFile curves = read_text("a.pdb", lines(atoms));
  EXPECT_EQ(xs(curves), (std::vector<float>{0, 3, 6, 9}));
  EXPECT_TRUE(curves.warnings.empty());
}

TEST(PdbReader, TakesTheBestOccupiedAlternative) {
  const auto two = [](char a, double of_a, char b, double of_b) {
    return read_text("a.pdb", lines({{0, "ATOM", " CA ", a, "GLY", 'A', 1, of_a},
                                     {1, "ATOM", " CA ", b, "GLY", 'A', 1, of_b}}));
  };
  EXPECT_EQ(xs(two('B', 0.4, 'C', 0.6)), (std::vector<float>{1}));
  EXPECT_EQ(xs(two('1', 0.7, '2', 0.3)), (std::vector<float>{0}));
  EXPECT_EQ(xs(two('B', 0.5, 'C', 0.5)), (std::vector<float>{0}));
  // Two residues in one place: one of them.
  EXPECT_EQ(xs(read_text("a.pdb", lines({{0, "ATOM", " CA ", 'A', "SER", 'A', 1, 0.3},
                                         {1, "ATOM", " CA ", 'B', "THR", 'A', 1, 0.7}}))),
            (std::vector<float>{1}));
  // Numbers used twice, without alternatives: two residues.
  EXPECT_EQ(xs(read_text("a.pdb", lines({{0}, {1}}))), (std::vector<float>{0, 1}));
}

TEST(PdbReader, TakesThePhosphorusOfNucleicAcids) {
  std::vector<Atom> atoms;
  for (int r = 0; r < 3; ++r) {
    if (r > 0) atoms.push_back({static_cast<float>(7 * r), "ATOM", " P  ", ' ', " DA", 'B', r});
    atoms.push_back({static_cast<float>(7 * r + 1), "ATOM", " C1'", ' ', " DA", 'B', r});
  }
  atoms.push_back({50, "HETATM", " P  ", ' ', "PO4", 'B', 9});
  const CurveFile curves = read_text("a.pdb", lines(atoms));
  EXPECT_EQ(xs(curves), (std::vector<float>{7, 14}));
  EXPECT_EQ(curves.strand_first, (Offsets{0, 2}));
  ASSERT_EQ(curves.warnings.size(), 1u);
  EXPECT_EQ(curves.warnings[0], "1 residue without C-alpha or P is left out: B/DA0");
}

TEST(PdbReader, TakesTheAtomThatTheUserNames) {
  const std::string text = lines({{0},
                                  {1, "ATOM", " CB "},
                                  {3, "ATOM", " CA ", ' ', "SER", 'A', 2},
                                  {4, "ATOM", " CB ", ' ', "SER", 'A', 2}});
  EXPECT_EQ(xs(read_atom("CB", text)), (std::vector<float>{1, 4}));
  EXPECT_EQ(read_atom("CB", text).labels.of(1), "A/SER2/CB");
  EXPECT_THROW(read_atom("BB", text), InputError);
}

TEST(PdbReader, EndsStrandsAtTerChainChangeAndGapAndSaysWhichGap) {
  const std::string ter = "TER       2      GLY A   2\n";
  EXPECT_EQ(read_text("a.pdb", lines({{0}, {3.8f}}) + ter + lines({{7}})).strand_first, (Offsets{0, 2, 3}));
  const CurveFile chains = read_text("a.pdb", lines({{0}, {3.8f, "ATOM", " CA ", ' ', "GLY", 'B'}}));
  EXPECT_EQ(chains.strand_first, (Offsets{0, 1, 2}));
  EXPECT_EQ(chains.labels.strand_names, (std::vector<std::string>{"A", "B"}));
  EXPECT_TRUE(chains.warnings.empty());
  const CurveFile gap = read_text(
      "a.pdb",
      lines({{0}, {4.5f, "ATOM", " CA ", ' ', "GLY", 'A', 2}, {9.5f, "ATOM", " CA ", ' ', "ALA", 'A', 7}}));
  EXPECT_EQ(gap.strand_first, (Offsets{0, 2, 3}));
  ASSERT_EQ(gap.warnings.size(), 1u);
  EXPECT_EQ(gap.warnings[0], "1 step longer than a bond is a break: A/GLY2/CA to A/ALA7/CA, 5.0 Angstrom");
}

/// As far apart as may be they are bonded, and a thousandth of an Angstrom further no more.
TEST(PdbReader, BreaksAtAStepThatIsLongerThanABond) {
  for (const auto& [name, longest] : {std::pair{" CA ", 4.5f}, std::pair{" P  ", 8.0f}}) {
    const auto strands = [&](float step) {
      return read_text("a.pdb", lines({{0, "ATOM", name}, {step, "ATOM", name, ' ', "GLY", 'A', 2}}))
          .strand_first;
    };
    EXPECT_EQ(strands(longest), (Offsets{0, 2})) << name;
    EXPECT_EQ(strands(longest + 0.001f), (Offsets{0, 1, 2})) << name;
  }
}

/// A ligand of a chain behind another one is none of its parts.
TEST(PdbReader, SaysWhereAChainGoesOnBehindAnother) {
  const auto at = [](float x, char chain, int number, const char* record = "ATOM") {
    return line({x, record, " CA ", ' ', "GLY", chain, number});
  };
  const CurveFile parted = read_text("a.pdb", at(0, 'A', 1) + at(9, 'B', 1) + at(3, 'A', 2) + at(12, 'B', 2));
  EXPECT_EQ(parted.strand_first, (Offsets{0, 1, 2, 3, 4}));
  ASSERT_EQ(parted.warnings.size(), 1u);
  EXPECT_EQ(parted.warnings[0],
            "2 parts of chains stand behind other chains, and are strands of their own: A/GLY2/CA, ...");
  const CurveFile whole =
      read_text("a.pdb", at(0, 'A', 1) + "TER\n" + at(9, 'B', 1) + "TER\n" + at(3, 'A', 9, "HETATM"));
  EXPECT_EQ(whole.spheres.size(), 2u);
  EXPECT_TRUE(whole.warnings.empty());
  const CurveFile letter_again =
      read_text("a.pdb", at(0, 'A', 1) + "TER\n" + at(9, 'B', 1) + "TER\n" + at(18, 'A', 2) + "TER\n");
  EXPECT_EQ(letter_again.strand_first, (Offsets{0, 1, 2, 3}));
  EXPECT_TRUE(letter_again.warnings.empty()) << "another chain of the letter of one that has ended";
  const std::string two = at(0, 'A', 1) + at(9, 'B', 1);
  EXPECT_TRUE(
      read_text("a.pdb", "MODEL 1\n" + two + "ENDMDL\nMODEL 2\n" + two + "ENDMDL\n").warnings.empty());
}

TEST(PdbReader, LeavesLigandsAfterTerOut) {
  const auto curves = read_text("a.pdb", lines({{0}}) + "TER\n" + lines({{3, "HETATM", " CA ", ' ', "MSE"}}));
  EXPECT_EQ(curves.spheres.size(), 1u);
}

TEST(PdbReader, KnowsModifiedResiduesOfTheSequence) {
  const std::string sequence = "SEQRES   1 A    2  GLY SEP\n",
                    modified = "MODRES 1ABC TPO A    3  THR  PHOSPHO\n";
  const auto curves = read_text(
      "a.pdb", sequence + modified +
                   lines({{0}, {3, "HETATM", " CA ", ' ', "SEP"}, {6, "HETATM", " CA ", ' ', "TPO"}}));
  EXPECT_EQ(curves.strand_first, (Offsets{0, 3}));
}

TEST(PdbReader, KnowsEveryResidueOfALineOfTheSequence) {
  for (std::size_t at = 0; at < 13; ++at) {
    std::string sequence = "SEQRES   1 A   13  ";
    for (std::size_t k = 0; k < 13; ++k) sequence += k == at ? "SEP " : "GLY ";
    const CurveFile curves =
        read_text("a.pdb", sequence + "\n" + lines({{0}, {3, "HETATM", " CA ", ' ', "SEP", 'A', 2}}));
    EXPECT_EQ(curves.spheres.size(), 2u) << at;
  }
}

// From a phosphorus to the next is farther than from a C-alpha to the next; between the two, what is allowed
// to either.
TEST(PdbReader, BreaksByTheLongerStepOfTwoAtoms) {
  const Atom alpha{0}, phosphorus{0, "ATOM", " P  ", ' ', " DA"};
  const auto strands = [](Atom first, Atom second, float step) {
    second.x = step, second.number = 2;
    return read_text("a.pdb", lines({first, second})).strand_closed.size();
  };
  for (const float step : {3.0f, 6.0f, 30.0f}) {
    const std::size_t longer = strands(phosphorus, phosphorus, step);
    EXPECT_EQ(strands(alpha, phosphorus, step), longer) << step;
    EXPECT_EQ(strands(phosphorus, alpha, step), longer) << step;
  }
  EXPECT_EQ(strands(phosphorus, alpha, 6), 1u);
  EXPECT_EQ(strands(alpha, alpha, 6), 2u);
}

TEST(PdbReader, ReadsModelsAsFrames) {
  const auto model = [](float x, const char* residue = "GLY") {
    return "MODEL        1\n" + lines({{x}, {x + 3, "ATOM", " CA ", ' ', residue, 'A', 2}}) + "ENDMDL\n";
  };
  const CurveFile curves = read_text("a.pdb", model(0) + model(1) + model(2) + "END\n");
  ASSERT_EQ(curves.later_frames.size(), 2u);
  EXPECT_EQ(xs(curves), (std::vector<float>{0, 3}));
  EXPECT_EQ(curves.later_frames[1][1].x, 5.0f);
  EXPECT_TRUE(curves.warnings.empty());
  const CurveFile other = read_text("a.pdb", model(0) + model(1) + model(2, "ALA") + model(3));
  EXPECT_EQ(other.later_frames.size(), 1u);
  ASSERT_EQ(other.warnings.size(), 1u);
  EXPECT_NE(other.warnings[0].find("line 12: the model that ends here is not of the same atoms"),
            std::string::npos)
      << other.warnings[0];
  EXPECT_EQ(read_text("a.pdb", lines({{0}}) + "END\n" + lines({{1}}) + "END\n").later_frames.size(), 1u);
  const std::string began = model(0) + model(1) + "MODEL        3\n";
  EXPECT_COMPLAINT("9: the file is truncated: it ends where the atoms of a model are due", "a.pdb", began);
  EXPECT_COMPLAINT("10: the file is truncated", "a.pdb", began + "REMARK   1\n");
  EXPECT_EQ(read_text("a.pdb", began + "ENDMDL\nEND\n").later_frames.size(), 1u);
}

// What one model ends is not ended in the next; a step that is too long in a later model alone breaks no
// strand.
TEST(PdbReader, BeginsEachModelAnewAndTakesItsStrandsFromTheFirst) {
  const auto model = [](float step) {
    return "MODEL        1\n" +
           lines({{0, "HETATM", " CA ", ' ', "MSE"}, {step, "ATOM", " CA ", ' ', "GLY", 'A', 2}}) +
           "TER\nENDMDL\n";
  };
  const CurveFile curves = read_text("a.pdb", model(3.8f) + model(6) + model(3));
  EXPECT_EQ(curves.strand_first, (Offsets{0, 2}));
  ASSERT_EQ(curves.later_frames.size(), 2u);
  EXPECT_EQ(curves.later_frames[0][1].x, 6.0f);
  EXPECT_EQ(curves.labels.strand_names, (std::vector<std::string>{"A"}));
}

// Whole lines, and the part after the atom's number, moved by a few columns.
TEST(PdbReader, RefusesShiftedColumns) {
  const std::string right = line({11.104f, "ATOM", " CA ", ' ', "ALA"});
  for (const std::size_t from : {0, 11, 17})
    for (const int by : {-2, -1, 1, 2}) {
      std::string shifted = right;
      if (by > 0)
        shifted.insert(from, std::string(static_cast<std::size_t>(by), ' '));
      else if (from > 0)
        shifted.erase(from, static_cast<std::size_t>(-by));
      else
        continue;
      const std::string said = complaint("a.pdb", lines({{0}}) + shifted);
      EXPECT_TRUE(said.starts_with("a.pdb:2: ")) << shifted << said;
    }
  std::string inner = right;  // residue, chain and number alone
  inner.erase(27, 1).insert(17, " ");
  EXPECT_COMPLAINT("1: the residue's name does not stand in columns 18 to 20", "a.pdb", inner);
  EXPECT_EQ(read_text("a.pdb", line({1, "ATOM", "CA  ", ' ', "ALA"})).spheres.size(),
            1u);  // left in its field
}

TEST(PdbReader, RefusesASingleFieldThatIsShifted) {
  const std::string right = line({1, "ATOM", " CA ", ' ', "ALA"});
  struct Field {
    std::size_t column;
    std::string text, reason;
  };
  const std::string coordinate = "a coordinate does not end in column 38, 46 or 54";
  for (const auto& [column, text, reason] : {Field{13, "  CA", "no atom's name starts in column 13 or 14"},
                                             {12, "CA   ", "column 12, before the atom's name, is not blank"},
                                             {31, "  1.000 ", coordinate},
                                             {39, "  1.000 ", coordinate},
                                             {47, "  1.000 ", coordinate}}) {
    std::string shifted = right;
    shifted.replace(column - 1, text.size(), text);
    EXPECT_EQ(complaint("a.pdb", shifted),
              "a.pdb:1: " + reason + "; the columns of this line are not those of the format");
  }
}

TEST(PdbReader, TakesResiduesOfFourLettersAndLinesThatEndWithTheCoordinates) {
  std::string atom = line({1, "ATOM", " CA ", ' ', "ALA"}).substr(0, 54);
  atom.replace(17, 4, "DGUA");
  const CurveFile curves = read_text("a.pdb", atom + "\n");
  EXPECT_EQ(xs(curves), std::vector<float>{1});
  EXPECT_EQ(curves.labels.of(0), "A/DGUA1/CA");
}

// "CA" from column 13 on may be either: an alpha carbon that is left in its field, or calcium.
TEST(PdbReader, TellsCalciumFromAlphaCarbons) {
  const auto with = [](const char* record, const char* residue, const char* element) {
    std::string atom = line({3, record, "CA  ", ' ', residue, 'A', 2});
    atom.pop_back();
    return xs(read_text("a.pdb", line({0}) + atom + std::string(76 - atom.size(), ' ') + element + "\n"));
  };
  const std::vector<float> both{0, 3}, first{0};
  EXPECT_EQ(with("ATOM", "ALA", ""), both);
  EXPECT_EQ(with("ATOM", "ALA", " C"), both);
  EXPECT_EQ(with("ATOM", "ALA", "Ca"), first);
  EXPECT_EQ(with("ATOM", " CA", ""), first);
  EXPECT_EQ(with("HETATM", "MSE", ""), first);
}

TEST(PdbReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("1: an atom's coordinates end at column 54, the line at 53", "a.pdb",
                   line({0}).substr(0, 53) + "\n");
  EXPECT_COMPLAINT("2: an atom's coordinates end at column 54, the line at 50", "a.pdb",
                   "REMARK\n" + line({0}).substr(0, 50) + "\n");
  std::string overflow = line({0});
  overflow.replace(30, 8, "  1.0e99");
  EXPECT_COMPLAINT("1: x '1.0e99' is too large", "a.pdb", overflow);
  overflow.replace(30, 8, "        ");
  EXPECT_COMPLAINT("1: x '' is not a number", "a.pdb", overflow);
  EXPECT_COMPLAINT("1: the file ends without a C-alpha", "a.pdb", "REMARK\n");
}

}  // namespace
}  // namespace catena
