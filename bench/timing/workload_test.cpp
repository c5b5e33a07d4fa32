#include "catena/bench/timing/workload.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "catena/core/error.h"
#include "catena/core/readers/test_file.h"

namespace catena::bench {
namespace {

WorkloadSpec with(const std::string& input, const std::function<void(InputOptions&)>& say) {
  WorkloadSpec spec{input};
  say(spec.options);
  return spec;
}

/// What is kept is of the same input by all that is said of it, and not only the last.
TEST(Workload, IsKeptByAllThatIsSaidOfItsInput) {
  const WorkloadSpec plain{"yarn:n=60"}, other = with("yarn:n=60", [](InputOptions&o) { o.window = 7; }),
                                         all{"path1:n=60", true}, one{"path1:n=60"};
  const auto first = workload(plain), second = workload(other);
  EXPECT_EQ(first->chains[0].exclusion().window, 1u);
  EXPECT_EQ(second->chains[0].exclusion().window, 7u);
  EXPECT_EQ(workload(all)->chains.size(), 56u);
  EXPECT_EQ(workload(one)->chains.size(), 1u);
  EXPECT_EQ(workload(plain), first);
  EXPECT_EQ(workload(other), second);
}

/// Commas and slashes part other things in the name of a case.
TEST(Workload, IsCalledByWhatIsSaidWithoutCommasAndFolders) {
  EXPECT_EQ(label_of(with("path1:n=10",
                          [](InputOptions& o) {
                            o.reading.columns = {"x", "y", "z"};
                          })),
            "path1:columns=x_y_z/n:10");
  EXPECT_EQ(label_of(with("path1:n=10", [](InputOptions& o) { o.reading.topology = "a/b.top"; })),
            "path1:topology=b.top/n:10");
}

/// Also where others of the scene were asked about before.
TEST(Workload, FactsAreOfTheBoxAndNumberThatAreSaid) {
  for (const std::string n : {"50", "60"}) {
    const WorkloadSpec boxed = with("yarn:n=" + n, [](InputOptions& o) {
      o.box_from = BoxFrom::options, o.box = {{900, 0, 0}};
    });
    EXPECT_TRUE(facts_of(boxed).in_box) << n;
    EXPECT_FALSE(facts_of({"yarn:n=" + n}).in_box) << n;
    EXPECT_EQ(facts_of({"yarn:n=" + n}).n, std::stoull(n));
  }
  EXPECT_THROW(facts_of({"yarn:n=-5"}), InputError);
}

TEST(Workload, SaysOnceWhatHadToBeAssumed) {
  const TestFile file("a.xyz", "2\nt\nC 0 0 0\nC 5 0 0\n");
  const WorkloadSpec moved =
      with(file.path().string(), [](InputOptions& o) { o.radius = 0.5f, o.reading.recentre = true; });
  testing::internal::CaptureStderr();
  facts_of(moved);
  EXPECT_NE(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  facts_of(moved);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace catena::bench
