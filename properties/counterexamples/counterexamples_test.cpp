#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "catena/properties/counterexamples/search.h"
#include "catena/properties/fuzz/failure_store.h"
#include "catena/properties/generators/simplifications.h"
#include "catena/properties/suite.h"
#include "catena/properties/variant_name.h"

/// The stored chains on which the paper's own arithmetic fails: properties/counterexamples/*.chain.
namespace catena::properties {
namespace {

const auto folder = std::filesystem::path(CATENA_SOURCE_DIR) / "properties/counterexamples";

struct Stored {
  std::filesystem::path file;
  std::string arithmetic;
  const Failure* failure;
};

std::vector<Stored> stored() {
  std::vector<Stored> all;
  for (const char* arithmetic : {"literal", "double"})
    for (const Failure& failure : failures()) {
      const auto file = folder / (std::string(arithmetic) + "-" + failure.name + ".chain");
      if (std::filesystem::exists(file)) all.push_back({file, arithmetic, &failure});
    }
  return all;
}

class Counterexamples : public testing::TestWithParam<Stored> {};
INSTANTIATE_TEST_SUITE_P(Stored, Counterexamples, testing::ValuesIn(stored()), [](const auto& test) {
  auto name = test.param.file.stem().string();
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST_P(Counterexamples, FailAsTheirFileSays) {
  const auto& [file, arithmetic, failure] = GetParam();
  const Chain chain = load_chain(file);
  const auto where = failure->on(Observer(arithmetic).of(chain));
  ASSERT_TRUE(where) << file;
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(text, text_of({arithmetic, failure, chain, *where, 1}));
}

TEST_P(Counterexamples, CannotBeSimplified) {
  const auto& [file, arithmetic, failure] = GetParam();
  Observer observer(arithmetic);
  Simplifications simpler_ones(load_chain(file));
  std::size_t tried = 0;
  for (; const auto candidate = simpler_ones.next(); ++tried)
    EXPECT_FALSE(failure->on(observer.of(*candidate))) << file;
  EXPECT_GT(tried, 0u);
}

TEST_P(Counterexamples, DoNotTroubleRobustArithmetic) {
  auto subjects = Subject::available();
  for (Subject& small : in_small_blocks(subjects)) subjects.push_back(std::move(small));
  std::erase_if(subjects, [](const Subject& subject) { return !subject.exact(); });
  ASSERT_FALSE(subjects.empty());
  Suite suite(std::move(subjects));
  for (const Finding& f : suite.check_all(Case::of(load_chain(GetParam().file))))
    ADD_FAILURE() << f.variant << ": " << f.property << ": " << f.what;
}

TEST(CounterexampleFiles, AreThereForEveryWayThatLiteralFails) {
  std::set<std::filesystem::path> known, there;
  std::size_t literal = 0;
  for (const Stored& one : stored()) known.insert(one.file), literal += one.arithmetic == "literal";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".chain") there.insert(entry.path());
  EXPECT_EQ(there, known) << "a file of no known failure";
  EXPECT_EQ(literal, failures().size());
}

TEST(CounterexampleSearch, FindsTheCommonOnesAndIsTheSameForTheSameSeed) {
  const auto once = smallest_counterexamples("literal", 300, 7),
             again = smallest_counterexamples("literal", 300, 7);
  ASSERT_GE(once.size(), 5u);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t k = 0; k < once.size(); ++k) EXPECT_EQ(text_of(once[k]), text_of(again[k]));
  for (const Counterexample& c : smallest_counterexamples("robust", 300, 7)) ADD_FAILURE() << text_of(c);
}

}  // namespace
}  // namespace catena::properties
