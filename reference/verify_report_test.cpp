#include "catena/reference/verify_report.h"

#include <gtest/gtest.h>

namespace catena::reference {
namespace {

VariantInfo info(const char* name, const char* arithmetic) {
  VariantInfo of;
  of.name = name, of.arithmetic = arithmetic, of.exact = of.arithmetic == "robust";
  return of;
}

std::string printed(const std::vector<VerifyRow>& rows) {
  testing::internal::CaptureStdout();
  VerifyReport report(false);
  for (const VerifyRow& row : rows) report.row(row);
  report.finish();
  return testing::internal::GetCapturedStdout();
}

/// A rounded variant that is wrong is told, but says nothing about those that promise to be exact.
TEST(VerifyReport, CallsAnExactVariantWrongAndNoOther) {
  const VariantInfo exact = info("A", "robust"), rounded = info("B", "literal");
  Verification right, wrong;
  right.ran = wrong.ran = true;
  wrong.verdict = Verdict::wrong, wrong.reason = "3 pairs repeated";
  const std::string by_rounded = printed({{"x", 0, 9, 5, exact, right}, {"x", 0, 9, 5, rounded, wrong}});
  EXPECT_NE(by_rounded.find("Every exact variant is exact, on 1 input: A\n"), std::string::npos)
      << by_rounded;
  EXPECT_NE(by_rounded.find("B on x: WRONG: 3 pairs repeated\n"), std::string::npos) << by_rounded;
  const std::string by_exact = printed({{"x", 0, 9, 5, exact, wrong}, {"x", 0, 9, 5, rounded, right}});
  EXPECT_NE(by_exact.find("NOT every exact variant is exact. Wrong: A\n"), std::string::npos) << by_exact;
  EXPECT_EQ(by_exact.find("Every exact variant"), std::string::npos) << by_exact;
}

/// Each figure in its own column, and which frame of the input it is.
TEST(VerifyReport, ShowsEachFigureInItsColumn) {
  const VariantInfo of = info("A", "robust");
  Verification v;
  v.ran = true;
  v.comparison.pairs = 11, v.comparison.missing = 22, v.comparison.invented = 33;
  v.enclosure.bounds = 99, v.enclosure.violations = 44;
  const std::string text = printed({{"x", 7, 9, 5, of, v}});
  const auto place = [&](const char* figure) { return text.find(figure); };
  EXPECT_LT(place("x #7"), place("11")) << text;
  EXPECT_LT(place("11"), place("22")) << text;
  EXPECT_LT(place("22"), place("33")) << text;
  EXPECT_LT(place("33"), place("44")) << text;
  EXPECT_NE(place("44"), std::string::npos) << text;
}

}  // namespace
}  // namespace catena::reference
