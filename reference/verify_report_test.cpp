#include "catena/reference/verify_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace catena::reference {
namespace {

VariantInfo info(const char* name, const char* arithmetic) {
  VariantInfo of;
  of.name = name, of.arithmetic = arithmetic, of.exact = of.arithmetic == "robust";
  return of;
}

std::string printed(const std::vector<VerifyRow>& rows) {
  ::testing::internal::CaptureStdout();
  VerifyReport report(false);
  for (const VerifyRow& row : rows) report.row(row);
  report.finish();
  return ::testing::internal::GetCapturedStdout();
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

/// Variants that gave the same, in figures and words, in one line: two by name, all by their number, others
/// by the first; two files of one name by their paths.
TEST(VerifyReport, GathersThoseOfOneAnswer) {
  const VariantInfo a = info("A", "robust"), b = info("B", "robust"), c = info("C", "robust"),
                    d = info("D", "robust");
  Verification right, certified;
  right.ran = certified.ran = true;
  right.comparison.pairs = certified.comparison.pairs = 5;
  certified.certificate =
      CertificateReport{.discarded = 11, .tested = 22, .excluded = 33, .each_once = true, .tree = {}};
  const auto lines = [](const std::vector<VerifyRow>& rows) {
    std::vector<std::string> found;
    std::istringstream text(printed(rows));
    for (std::string line; std::getline(text, line);)
      if (line.starts_with("  ") && line.find("variants") == std::string::npos) {
        std::istringstream words(line);
        std::string one, word;
        while (words >> word) one += (one.empty() ? "" : " ") + word;
        found.push_back(one);
      }
    return found;
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(lines({{"x", 0, 9, 5, a, right}, {"x", 0, 9, 5, b, right}, {"x", 0, 9, 5, c, certified}}),
            (Lines{"x A, B 5 0 0 - exact",
                   "x C 5 0 0 - exact, certified: 11 node pairs discarded, 22 pairs tested"}));
  EXPECT_EQ(lines({{"x", 0, 9, 5, a, right}, {"x", 0, 9, 5, b, right}, {"x", 0, 9, 5, c, right}}),
            (Lines{"x all 3 5 0 0 - exact"}));
  EXPECT_EQ(lines({{"x", 0, 9, 5, a, right},
                   {"x", 0, 9, 5, b, right},
                   {"x", 0, 9, 5, c, right},
                   {"x", 0, 9, 5, d, certified}})[0],
            "x A and 2 more 5 0 0 - exact");
  Verification other = right;
  other.comparison.pairs = 6;
  EXPECT_EQ(lines({{"x", 0, 9, 5, a, right}, {"x", 0, 9, 5, b, other}}),
            (Lines{"x A 5 0 0 - exact", "x B 6 0 0 - exact"}));
  EXPECT_EQ(lines({{"/p/x", 0, 9, 5, a, right}, {"/q/x", 0, 9, 5, a, right}, {"/p/x", 1, 9, 5, a, right}}),
            (Lines{"x A 5 0 0 - exact", "/q/x A 5 0 0 - exact", "x #1 A 5 0 0 - exact"}));
}

/// Who is exact somewhere and wrong nowhere, on how many inputs; who was not asked, and why.
TEST(VerifyReport, BeginsWithWhoIsExactAndEndsWithWhoWasNotAsked) {
  const VariantInfo a = info("A", "robust"), b = info("B", "robust");
  Verification right, refused, absent;
  right.ran = true;
  refused.verdict = Verdict::refused, refused.reason = "too many";
  absent.verdict = Verdict::unavailable, absent.reason = "no device";
  const std::string text = printed({{"x", 0, 9, 5, a, right},
                                    {"y", 0, 9, 5, a, right},
                                    {"x", 0, 9, 5, b, refused},
                                    {"y", 0, 9, 5, b, absent}});
  EXPECT_NE(text.find("Every exact variant is exact, on 2 inputs: A\n"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\n\nnot available here, no device: B\n\n2 exact, 1 refused, 1 unavailable\n"))
      << text;
  const std::string all = printed({{"x", 0, 9, 5, a, right}});
  EXPECT_TRUE(all.ends_with("exact\n\n1 exact\n")) << all;
}

/// Want of memory is no wrong answer, and no right one either.
TEST(VerifyReport, NamesTheUndecidedApart) {
  const VariantInfo a = info("A", "robust"), b = info("B", "robust"), c = info("C", "robust");
  Verification right, wrong, undecided;
  right.ran = wrong.ran = true;
  wrong.verdict = Verdict::wrong, wrong.reason = "why";
  undecided.verdict = Verdict::undecided, undecided.reason = "out of memory";
  const std::string text =
      printed({{"x", 0, 9, 5, a, right}, {"x", 0, 9, 5, b, right}, {"y", 0, 9, 5, b, undecided}});
  EXPECT_TRUE(text.starts_with(
      "\nNot decided on every input: B\nEvery other exact variant is exact, on 2 inputs: A\n"))
      << text;
  EXPECT_NE(text.find("undecided: out of memory\n"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\n\n2 exact, 1 undecided\n")) << text;
  const std::string both = printed({{"x", 0, 9, 5, c, wrong}, {"y", 0, 9, 5, b, undecided}});
  EXPECT_NE(both.find("NOT every exact variant is exact. Wrong: C\n"), std::string::npos) << both;
  VerifyReport report(true);
  EXPECT_EQ(report.undecided(), 0u);
  ::testing::internal::CaptureStdout();
  report.row({"x", 0, 9, 5, b, undecided});
  EXPECT_NE(
      ::testing::internal::GetCapturedStdout().find("\"verdict\":\"undecided\",\"reason\":\"out of memory\""),
      std::string::npos);
  EXPECT_EQ(report.undecided(), 1u);
  EXPECT_FALSE(report.anything_wrong());
}

/// Each number under its own key, and none that says nothing.
TEST(VerifyReport, WritesARowAsJson) {
  const VariantInfo of = info("A", "robust");
  Verification v;
  v.verdict = Verdict::wrong, v.reason = "why", v.ran = true;
  v.comparison.pairs = 11, v.comparison.missing = 12, v.comparison.invented = 13,
  v.comparison.neighbours = 14;
  v.comparison.repeated = 15, v.comparison.malformed = 16, v.comparison.inconsistent_counts = 17,
  v.comparison.wrong_counts = 18;
  v.comparison.worst_margin = 0.5;
  v.enclosure.bounds = 19, v.enclosure.violations = 20, v.enclosure.worst_shortfall = 0.25;
  v.shape.depth = 21, v.shape.nodes = 22;
  v.certificate = CertificateReport{.discarded = 23, .tested = 24, .excluded = 25, .tree = {}};
  const auto json = [&](const Verification& result) {
    ::testing::internal::CaptureStdout();
    VerifyReport report(true);
    report.row({"x", 7, 9, 5, of, result});
    report.finish();
    return nlohmann::ordered_json::parse(::testing::internal::GetCapturedStdout());
  };
  nlohmann::ordered_json expected{{"input", "x"},
                                  {"frame", 7},
                                  {"n", 9},
                                  {"variant", "A"},
                                  {"exact_pairs", 5},
                                  {"pairs", 11},
                                  {"missing", 12},
                                  {"invented", 13},
                                  {"neighbours", 14},
                                  {"repeated", 15},
                                  {"malformed", 16},
                                  {"inconsistent_counts", 17},
                                  {"worst_margin", 0.5},
                                  {"wrong_counts", 18},
                                  {"bounds", 19},
                                  {"unenclosed", 20},
                                  {"worst_shortfall", 0.25},
                                  {"depth", 21}};
  expected["certificate"] = {{"holds", false}, {"discarded", 23}, {"tested", 24}, {"excluded", 25}};
  expected["verdict"] = "wrong", expected["reason"] = "why";
  EXPECT_EQ(json(v), expected);
  v.by_pairs = false;
  EXPECT_EQ(json(v).count("missing") + json(v).count("worst_margin"), 0u);
  EXPECT_EQ(json(v)["wrong_counts"], 18);
  Verification absent;
  absent.verdict = Verdict::unavailable, absent.reason = "no device";
  EXPECT_EQ(json(absent), (nlohmann::ordered_json{{"input", "x"},
                                                  {"frame", 7},
                                                  {"n", 9},
                                                  {"variant", "A"},
                                                  {"exact_pairs", 5},
                                                  {"verdict", "unavailable"},
                                                  {"reason", "no device"}}));
}

}  // namespace
}  // namespace catena::reference
