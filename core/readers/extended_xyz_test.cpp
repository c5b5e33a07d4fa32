#include "catena/core/readers/extended_xyz.h"

#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

CurveFile titled(const std::string& title) {
  return read_text("a.xyz", "1\n" + title + " Properties=species:S:1:pos:R:3\nC 0 0 0\n");
}

TEST(XyzReader, ReadsExtendedXyzAsItsPropertiesSay) {
  const CurveFile curves =
      read_text("a.xyz",
                "2\nLattice=\"9 0 0 0 9 0 0 0 9\" "
                "Properties=species:S:1:forces:R:3:pos:R:3:radius:R:1:id:I:1 pbc=\"T T T\"\n"
                "C 9 9 9 1 2 3 0.5 17\nO 9 9 9 4 5 6 0.25 3\n");
  EXPECT_EQ(curves.spheres, (std::vector<Sphere>{{1, 2, 3, 0.5f}, {4, 5, 6, 0.25f}}));
  EXPECT_TRUE(curves.has_radii);
  EXPECT_EQ(curves.labels.of(0), "17");
  EXPECT_EQ(curves.warnings, (std::vector<std::string>{"not read: 'forces'"}));
  EXPECT_COMPLAINT("2: Properties 'species:S:1' has no pos:R:3", "a.xyz",
                   "1\nProperties=species:S:1\nC 0 0 0\n");
  // A position in words is none, and of two ids none is the sphere's.
  EXPECT_COMPLAINT("2: Properties 'pos:S:3' has no pos:R:3", "a.xyz", "1\nProperties=pos:S:3\n0 0 0\n");
  // A whole number is no radius.
  const CurveFile whole = read_text("a.xyz", "1\nProperties=pos:R:3:radius:I:1\n1 2 3 9\n");
  EXPECT_FALSE(whole.has_radii);
  EXPECT_EQ(whole.warnings, (std::vector<std::string>{"not read: 'radius'"}));
  const CurveFile two_ids = read_text("a.xyz", "1\nProperties=id:I:2:pos:R:3\n8 9 1 2 3\n");
  EXPECT_EQ(two_ids.spheres, (std::vector<Sphere>{{1, 2, 3, 0}}));
  EXPECT_EQ(two_ids.warnings, (std::vector<std::string>{"not read: 'id'"}));
  EXPECT_COMPLAINT("2: Properties 'pos:R' is not", "a.xyz", "1\nProperties=pos:R\nC 0 0 0\n");
  EXPECT_COMPLAINT("2: Properties: '0' of 'id' is no number of columns", "a.xyz",
                   "1\nProperties=pos:R:3:id:I:0\n0 0 0\n");
  EXPECT_COMPLAINT("2: Properties: '99999999999999' of 'pos'", "a.xyz",
                   "1\nProperties=pos:R:99999999999999\nC 0 0 0\n");
  EXPECT_COMPLAINT("3: the row has 3 columns, not 4", "a.xyz", "1\nProperties=species:S:1:pos:R:3\n0 0 0\n");
}

/// One frame of a sphere, with this title.
TEST(XyzReader, TakesTheLatticeAsAPeriodicBoxUnlessPbcSaysOtherwise) {
  using Boxes = std::vector<PeriodicBox>;
  for (const std::string lattice :
       {"Lattice=\"9 0 0 1 8 0 -2 3.5 7\"", "lattice = '9 0 0 1 8 0 -2 3.5 7'",
        "Lattice={9 0 0 1 8 0 -2 3.5 7}", "Lattice=[[9, 0, 0], [1, 8, 0], [-2, 3.5, 7]]"}) {
    EXPECT_EQ(titled(lattice).boxes, (Boxes{{{9, 8, 7}, 1, -2, 3.5}})) << lattice;
    EXPECT_TRUE(titled(lattice).box_is_periodic);
    EXPECT_EQ(titled("pbc=\"T F T\" " + lattice).boxes, (Boxes{{{9, 0, 7}, 1, -2, 3.5}}));
    EXPECT_EQ(titled(lattice + " pbc=[True, true, 0]").boxes, (Boxes{{{9, 8, 0}, 1, -2, 3.5}}));
    EXPECT_EQ(titled(lattice + " pbc=\"0 1 t\"").boxes, (Boxes{{{0, 8, 7}, 1, -2, 3.5}}));
    EXPECT_EQ(titled(lattice + " pbc=\"T F F\"").boxes, (Boxes{{{9, 0, 0}, 1, -2, 3.5}}));
    EXPECT_EQ(titled(lattice + " pbc=\"F T F\"").boxes, (Boxes{{{0, 8, 0}, 1, -2, 3.5}}));
    EXPECT_EQ(titled(lattice + " pbc=\"F F T\"").boxes, (Boxes{{{0, 0, 7}, 1, -2, 3.5}}));
    EXPECT_TRUE(titled(lattice + " pbc=\"F F F\"").boxes.empty());
    EXPECT_TRUE(titled(lattice).warnings.empty());
  }
  EXPECT_TRUE(titled("pbc=\"T T T\"").boxes.empty());
  for (const char* turned :
       {"0 9 0 9 0 0 0 0 9", "9 1 0 0 9 0 0 0 9", "9 0 0 0 9 1 0 0 9", "-9 0 0 0 9 0 0 0 9",
        "9 0 0 0 -9 0 0 0 9", "9 0 0 0 9 0 0 0 -9", "9 0 0 0 0 0 0 0 9"}) {
    const CurveFile curves = titled(std::string("Lattice=\"") + turned + "\"");
    EXPECT_TRUE(curves.boxes.empty());
    ASSERT_EQ(curves.warnings.size(), 1u) << turned;
    EXPECT_TRUE(curves.warnings[0].starts_with("line 2: the Lattice is left out, and nothing is periodic"));
  }
  const std::string end = "\nC 0 0 0\n";
  EXPECT_COMPLAINT("2: Lattice '\"9 9 9\"' has 3 numbers, not 9", "a.xyz", "1\nLattice=\"9 9 9\"" + end);
  EXPECT_COMPLAINT("2: Lattice: 'a' is not a number", "a.xyz", "1\nLattice=\"a 0 0 0 9 0 0 0 9\"" + end);
  EXPECT_COMPLAINT("2: Lattice '\"9 0 0 0 9 0 0 0 9 9\"' has 10 numbers, not 9", "a.xyz",
                   "1\nLattice=\"9 0 0 0 9 0 0 0 9 9\"" + end);
  for (const std::string twice : {"Lattice=\"9 0 0 0 9 0 0 0 9\"", "pbc=\"T T T\"", "Properties=pos:R:3"})
    EXPECT_NE(complaint("a.xyz", "1\n" + twice + " a=b a=c " + twice + "\n0 0 0\n")
                  .find("' stands twice; keep one of them"),
              std::string::npos)
        << twice;
  for (const std::string pbc : {"\"T T\"", "\"T T T F\"", "\"T T maybe\"", "\"T T 2\""})
    EXPECT_COMPLAINT("2: pbc '" + pbc + "' is not T or F three times", "a.xyz", "1\npbc=" + pbc + end);
}

TEST(XyzReader, TakesTheBoxOfEachFrame) {
  const auto frame = [](const std::string& lattice) { return "1\n" + lattice + "\nC 0 0 0\n"; };
  const std::string nine = frame("Lattice=\"9 0 0 0 9 0 0 0 9\""),
                    eight = frame("Lattice=\"8 0 0 0 8 0 0 0 8\""),
                    turned = frame("Lattice=\"0 9 0 9 0 0 0 0 9\""), none = frame("t");
  EXPECT_EQ(read_text("a.xyz", nine + eight).boxes, (std::vector<PeriodicBox>{{{9, 9, 9}}, {{8, 8, 8}}}));
  EXPECT_TRUE(read_text("a.xyz", turned + turned).boxes.empty());
  EXPECT_COMPLAINT("5: this frame and the first differ in having a periodic Lattice", "a.xyz", nine + none);
  EXPECT_COMPLAINT("5: this frame and the first differ in having a periodic Lattice", "a.xyz", none + nine);
  EXPECT_COMPLAINT("5: this Lattice does not lie along the axes", "a.xyz", nine + turned);
  EXPECT_COMPLAINT("5: this Lattice lies along the axes, the first does not", "a.xyz", turned + nine);
}

TEST(XyzReader, SaysOnceWhatItDoesNotReadAndRefusesRadiiInSomeFramesOnly) {
  const std::string plain = "1\nProperties=pos:R:3:forces:R:3\n0 0 0 1 1 1\n",
                    radii = "1\nProperties=pos:R:3:radius:R:1\n0 0 0 1\n";
  EXPECT_EQ(read_text("a.xyz", plain + plain).warnings, std::vector<std::string>{"not read: 'forces'"});
  EXPECT_COMPLAINT("6: this frame and the first differ in having radii", "a.xyz", plain + radii);
  EXPECT_COMPLAINT("6: this frame and the first differ in having radii", "a.xyz", radii + plain);
}

}  // namespace
}  // namespace catena
