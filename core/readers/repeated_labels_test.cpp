#include "catena/core/readers/repeated_labels.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

// Against a map of all labels.
RC_GTEST_PROP(RepeatedLabels, AreCounted, ()) {
  CurveFile curves;
  const bool numbers = *rc::gen::arbitrary<bool>(), named = *rc::gen::arbitrary<bool>();
  std::map<std::pair<std::size_t, int>, std::uint32_t> first;
  std::size_t times = 0;
  for (std::size_t s = 0; s < 3; ++s) {
    for (auto left = *rc::gen::inRange(1, 8); left > 0; --left) {
      const int label = *rc::gen::inRange(0, 40);
      numbers ? curves.labels.add(std::int64_t{label}) : curves.labels.add(std::to_string(label));
      times += !first.emplace(std::pair(named ? s : 0, label), curves.labels.size() - 1).second;
      curves.add_point(0, 0, 0);
    }
    curves.end_strand();
    if (named) curves.labels.strand_names.push_back(std::to_string(s));
  }
  const auto said = said_of_repeated_labels(curves);
  RC_ASSERT(said.has_value() == (times > 0));
  if (said) RC_ASSERT(said->starts_with(std::to_string(times) + " label"));
}

TEST(RepeatedLabels, AreSaidOfTheFilesThatHaveThem) {
  const auto warnings = [](const char* name, const std::string& text) {
    return read_text(name, text).warnings;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(warnings("a.csv", "id,x,y,z\np,0,0,0\nq,1,0,0\np,2,0,0\n"),
            Texts{"1 label is also that of an earlier sphere, the first 'p' of spheres 0 and 2; by i and j "
                  "they are told "
                  "apart"});
  EXPECT_EQ(warnings("a.csv", "id,strand,x,y,z\n1,a,0,0,0\n2,a,1,0,0\n1,b,2,0,0\n"), Texts{});
  EXPECT_EQ(warnings("a.csv", "x,y,z\n0,0,0\n1,0,0\n"), Texts{});
  // Of all that repeat, the first.
  for (const auto& [p, q] : {std::pair("p", "q"), {"q", "p"}, {"chr1:7", "chr2:9"}, {"chr2:9", "chr1:7"}})
    EXPECT_EQ(
        warnings("a.csv",
                 fmt::format("id,x,y,z\n{0},0,0,0\n{1},1,0,0\n{1},2,0,0\n{0},3,0,0\n{0},4,0,0\n", p, q)),
        Texts{fmt::format(
            "3 labels are also those of an earlier sphere, the first '{}' of spheres 0 and 3; by i and "
            "j they are told apart",
            p)});
  const std::string residue =
      "ATOM      1  CA  GLY A   1       0.000   0.000   0.000  1.00  0.00           C\n";
  EXPECT_EQ(warnings("a.pdb", residue + residue).size(), 1u);
  // Two strands of one name are no more told apart by it, wherever the others are.
  std::string other = residue;
  other.replace(other.find("GLY A"), 5, "GLY B");
  EXPECT_EQ(warnings("a.pdb", residue + "TER\n" + other + "TER\n" + residue),
            Texts{"1 label is also that of an earlier sphere, the first 'A/GLY1/CA' of spheres 0 and 2; by i "
                  "and j they are told apart"});
}

}  // namespace
}  // namespace catena
