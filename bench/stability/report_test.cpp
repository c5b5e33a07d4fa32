#include "catena/bench/stability/report.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <optional>

#include "catena/bench/stability/not_finite.h"
#include "catena/bench/stability/run.h"
#include "catena/core/input/input.h"

/// What the stability matrix prints, word for word, of cells made by hand.
namespace catena::bench {
namespace {

using Form = StabilityReport::Form;

std::string printed(const std::function<void()>& print) {
  testing::internal::CaptureStdout();
  print();
  return testing::internal::GetCapturedStdout();
}

Cell cell(const std::string& variant, Outcome outcome, const std::string& arithmetic = "literal") {
  Cell made{"knot", variant, arithmetic, 9, 5, outcome, false, 0, {}};
  made.found.ran = made.found.by_pairs = outcome != Outcome::refused && outcome != Outcome::unavailable;
  return made;
}

Cell wrong(const std::string& variant, std::uint64_t missing, std::uint64_t invented) {
  Cell made = cell(variant, Outcome::wrong);
  made.found.comparison.missing = missing, made.found.comparison.invented = invented;
  made.found.comparison.worst_margin = 1e-7;
  return made;
}

/// What the line of a cell says of its outcome.
std::string outcome(const Cell& of) {
  const std::string line =
      printed([&] { StabilityReport(Form::cells, {"knot"}, {"A"}, {"literal"}).scene({of}); });
  return line.substr(line.find("  5  ") + 5);
}

TEST(StabilityReport, TellsACellInShort) {
  EXPECT_EQ(outcome(cell("A", Outcome::exact)), "exact\n");
  Cell short_of = cell("A", Outcome::unenclosed);
  short_of.found.enclosure.bounds = 200, short_of.found.enclosure.violations = 5;
  EXPECT_EQ(outcome(short_of), "unenclosed 2.5 %\n");
  short_of.found.enclosure.violations = 200;
  EXPECT_EQ(outcome(short_of), "unenclosed 100 %\n");
  EXPECT_EQ(outcome(wrong("A", 4, 2)), "wrong -4 +2 by 1e-07\n");
  Cell counted = wrong("A", 0, 0);
  counted.found.by_pairs = false, counted.found.comparison.wrong_counts = 7;
  EXPECT_EQ(outcome(counted), "wrong 7 counts\n");
  Cell nan = wrong("A", 1, 0);
  nan.outcome = Outcome::not_finite, nan.not_finite_nodes = 3;
  EXPECT_EQ(outcome(nan), "3 nodes NaN -1 +0 by 1e-07\n");
  nan.found.comparison = {};
  EXPECT_EQ(outcome(nan), "3 nodes NaN\n");
  Cell faulty = wrong("A", 1, 0);
  faulty.defect = true, faulty.found.reason = "why";
  EXPECT_EQ(outcome(faulty), "DEFECT wrong -1 +0 by 1e-07: why\n");
}

/// The worst of an arithmetic: a defect before an outcome, then the wrong pairs, whichever way they are.
TEST(StabilityReport, ShowsTheWorst) {
  const auto worst = [](const std::vector<Cell>& cells) {
    const std::string text =
        printed([&] { StabilityReport(Form::table, {"knot"}, {"A"}, {"literal"}).scene(cells); });
    const std::string line = text.substr(text.find("  5  ") + 5);
    return line.substr(0, line.find_last_not_of(" \n") + 1);
  };
  Cell defect = cell("A", Outcome::unenclosed);
  defect.found.enclosure.bounds = 4, defect.found.enclosure.violations = 1;
  EXPECT_EQ(worst({defect, wrong("B", 1, 0)}), "wrong -1 +0 by 1e-07 (1/2)");
  defect.defect = true;
  for (const auto& cells : {std::vector{defect, wrong("B", 1, 0)}, std::vector{wrong("B", 1, 0), defect}})
    EXPECT_EQ(worst(cells), "unenclosed 25 % (1/2)");
  for (const auto& cells :
       {std::vector{wrong("A", 1, 0), wrong("B", 0, 3)}, std::vector{wrong("A", 0, 3), wrong("B", 1, 0)}})
    EXPECT_EQ(worst(cells), "wrong -0 +3 by 1e-07");
}

TEST(StabilityReport, CountsWhoEndsLikeTheWorstOfAnArithmeticAmongItsOwn) {
  Cell robust = wrong("C", 2, 0);
  robust.arithmetic = "robust";
  const std::string line = printed([&] {
    StabilityReport(Form::table, {"knot"}, {"A"}, {"literal", "robust"})
        .scene({wrong("A", 1, 0), cell("B", Outcome::exact), robust});
  });
  EXPECT_NE(line.find("wrong -2 +0 by 1e-07  "), std::string::npos) << line;
  EXPECT_NE(line.find("wrong -1 +0 by 1e-07 (1/2)"), std::string::npos) << line;
}

TEST(StabilityReport, HasAHeadOfItsFormAndArithmeticsInTheirOrder) {
  const auto head = [](Form form) {
    return printed([&] {
      StabilityReport(form, {"knot"}, {"A"}, {"double", "robust", "literal", "robust"});
    });
  };
  const std::string table = head(Form::table);
  EXPECT_EQ(table.substr(0, 15), "scene     pairs");
  EXPECT_LT(table.find("robust"), table.find("literal"));
  EXPECT_LT(table.find("literal"), table.find("double"));
  EXPECT_EQ(table.find("robust"), table.rfind("robust"));
  EXPECT_EQ(head(Form::cells), "scene  variant     pairs  outcome\n");
  EXPECT_EQ(head(Form::json), "");
}

/// Four names are told, five are counted.
TEST(StabilityReport, EndsWithWhatWasLeftOutAndWhatIsADefect) {
  const auto end = [](const std::vector<Cell>& cells, Form form = Form::cells) {
    std::optional<StabilityReport> report;
    printed([&] {
      report
          .emplace(form, std::vector<std::string>{"knot"}, std::vector<std::string>{"A"},
                   std::vector<std::string>{"literal"})
          .scene(cells);
    });
    return printed([&] { report->finish(); });
  };
  std::vector<Cell> cells;
  for (const char* name : {"A", "B", "C", "D"}) {
    cells.push_back(cell(name, name[0] < 'C' ? Outcome::refused : Outcome::unavailable));
    cells.back().found.reason = "too long";
  }
  EXPECT_EQ(end(cells), "literal: 2 unavailable, 2 refused\nleft out: A, B, C, D on knot: too long\n");
  cells.push_back(cells[0]);
  cells.back().variant = "E";
  EXPECT_EQ(end(cells), "literal: 2 unavailable, 3 refused\nleft out: 5 variants on knot: too long\n");
  Cell faulty = wrong("F", 1, 0);
  faulty.defect = true, faulty.found.reason = "why";
  EXPECT_EQ(end({faulty}), "literal: 1 wrong\nDEFECT: F on knot: wrong -1 +0 by 1e-07 why\n");
  EXPECT_EQ(end({faulty}, Form::json), "");
}

TEST(NotFiniteNodes, AreCountedOnceWhereverTheyStand) {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  NotFiniteNodes nodes;
  nodes.sphere(9, {0, 0, 0, inf}, 1, {0, 0, 0, 1});
  EXPECT_EQ(nodes.count(), 0u) << "an infinite radius is an honest bound";
  nodes.sphere(9, {0, 0, 0, inf}, 2, {0, 0, 0, nan});
  EXPECT_EQ(nodes.count(), 1u);
  nodes.sphere(8, {inf, 0, 0, 1}, 2, {0, 0, 0, nan});
  nodes.sphere(8, {inf, 0, 0, 1}, 3, {0, nan, 0, 1});
  nodes.sphere(7, {0, 0, -inf, 1}, 4, {0, 0, 0, 1});
  EXPECT_EQ(nodes.count(), 4u);
}

/// Of each two spheres, which is as few as are asked, the later one: it lies alone.
TEST(StabilityRun, AsksTheMiddleOfEachPart) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 512; ++i)
    spheres.push_back({i % 2 == 0 ? 0.0f : 10.0f * static_cast<float>(i), 0, 0, 1});
  EXPECT_EQ(estimated_overlaps(Chain(spheres)), 0);
  EXPECT_EQ(estimated_seconds("aCPU2+CPU2", open_input("rod:n=49999").animation->frame(0), 0), 0);
}

}  // namespace
}  // namespace catena::bench
