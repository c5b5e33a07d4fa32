#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "catena/properties/fuzz/failure_store.h"
#include "catena/properties/suite.h"
#include "catena/properties/variant_name.h"

/// Past failures, replayed in every run: properties/corpus/*.chain.
namespace catena::properties {
namespace {

std::set<std::filesystem::path> corpus() {
  std::set<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(CATENA_SOURCE_DIR) / "properties/corpus"))
    if (entry.path().extension() == ".chain") files.insert(entry.path());
  return files;
}

TEST(Corpus, PastFailuresStayFixed) {
  auto subjects = Subject::available();
  for (Subject& small : in_small_blocks(subjects)) subjects.push_back(std::move(small));
  Suite suite(std::move(subjects));
  EXPECT_FALSE(corpus().empty());
  for (const auto& file : corpus())
    for (const Finding& f : suite.check_all(Case::of(load_chain(file))))
      ADD_FAILURE() << file << ": " << f.variant << ": " << f.property << ": " << f.what;
}

TEST(Corpus, LargestSpheresApartByADenormalDoNotCollide) {
  const auto file =
      std::filesystem::path(CATENA_SOURCE_DIR) / "properties/corpus/far_apart_by_a_denormal.chain";
  EXPECT_EQ(Case::of(load_chain(file)).exact.pair_count, 0u);
}

}  // namespace
}  // namespace catena::properties
