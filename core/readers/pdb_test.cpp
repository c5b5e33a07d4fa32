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
};

std::string line(const Atom& a) {
  return fmt::format("{:<6}{:>5} {}{}{:>3} {}{:>4}    {:8.3f}{:8.3f}{:8.3f}\n", a.record, 1, a.name,
                     a.alternate, a.residue, a.chain, 1, a.x, 0.0, 0.0);
}

std::string lines(std::initializer_list<Atom> atoms) {
  std::string text;
  for (const Atom& atom : atoms) text += line(atom);
  return text;
}

TEST(PdbReader, TakesCAlphasByColumns) {
  const CurveFile curves = read_text("a.pdb", lines({{0},
                                                     {1, "ATOM", " N  "},
                                                     {2, "HETATM", "CA  "},  // calcium
                                                     {3, "ATOM", " CA ", 'A'},
                                                     {3.5, "ATOM", " CA ", 'B'},  // second alternative
                                                     {6, "HETATM", " CA ", ' ', "MSE"},
                                                     {7, "HETATM", " CA ", ' ', "LIG"}}) +
                                                  "END\n");
  EXPECT_EQ(curves.strand_first, (Offsets{0, 3}));
  EXPECT_EQ(curves.spheres[2].x, 6.0f);
  EXPECT_FALSE(curves.has_radii);
}

TEST(PdbReader, EndsStrandsAtTerChainChangeAndGap) {
  const std::string ter = "TER       2      GLY A   2\n";
  EXPECT_EQ(read_text("a.pdb", lines({{0}, {3.8f}}) + ter + lines({{7}})).strand_first, (Offsets{0, 2, 3}));
  EXPECT_EQ(read_text("a.pdb", lines({{0}, {3.8f, "ATOM", " CA ", ' ', "GLY", 'B'}})).strand_first,
            (Offsets{0, 1, 2}));
  EXPECT_EQ(read_text("a.pdb", lines({{0}, {4.5f}, {9.5f}})).strand_first, (Offsets{0, 2, 3}));
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

TEST(PdbReader, ReadsTheFirstModelOnly) {
  const std::string model = "MODEL        1\n" + lines({{0}, {3}}) + "ENDMDL\n";
  EXPECT_EQ(read_text("a.pdb", model + model).spheres.size(), 2u);
  EXPECT_EQ(read_text("a.pdb", "MODEL        1\n" + lines({{0}}) + "MODEL        2\n" + lines({{0}}))
                .spheres.size(),
            1u);
}

TEST(PdbReader, ComplainsWithFileAndLine) {
  EXPECT_COMPLAINT("2: the C-alpha's coordinates end at column 54", "a.pdb",
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
