#include "catena/core/executor/large_vector.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <random>
#include <vector>

#include "catena/properties/testing/sanitized.h"

namespace catena {
namespace {

std::vector<std::uint64_t> some_from(std::uint64_t first, std::size_t size) {
  std::vector<std::uint64_t> some(size);
  std::iota(some.begin(), some.end(), first);
  return some;
}

TEST(AppendLarge, KeepsWhatWasThereWhateverItGrowsBy) {
  std::mt19937 dice(3);
  for (const std::size_t likely : {0u, 5u, 1u << 22})
    for (const std::size_t all : {std::size_t{10}, large_page / 8 - 1, large_page / 8 + 1, large_page}) {
      std::vector<std::uint64_t> values;
      while (values.size() < all) {
        const auto more = some_from(values.size(), 1 + dice() % (1 + all / 3));
        append_large(values, std::span(more), likely);
      }
      ASSERT_EQ(values, some_from(0, values.size())) << likely << ' ' << all;
    }
}

TEST(AppendLarge, HasAddressesForWhatIsLikelyOnceItIsMapped) {
  constexpr std::size_t likely = std::size_t{1} << 22, mapped = least_mapped / sizeof(std::uint64_t);
  std::vector<std::uint64_t> values;
  append_large(values, std::span<const std::uint64_t>(some_from(0, mapped - 1)), likely);
  EXPECT_LT(values.capacity(), mapped) << "few as yet";
  append_large(values, std::span<const std::uint64_t>(some_from(mapped - 1, 1)), likely);
  EXPECT_GE(values.capacity(), likely);
}

/// Of this process: appends with a wish for far more addresses than it then may have.
bool appends_in_few_addresses() {
  const rlimit most{std::uint64_t{3} << 30, std::uint64_t{3} << 30};
  setrlimit(RLIMIT_AS, &most);
  std::vector<std::uint64_t> values;
  for (int k = 0; k < 20; ++k) {
    const auto more = some_from(values.size(), 100'000);
    append_large(values, std::span(more), std::size_t{1} << 32);
  }
  return values == some_from(0, 2'000'000) && values.capacity() < std::size_t{1} << 24;
}

/// Addresses may be counted as memory is: then no more is asked for than is needed.
TEST(AppendLarge, MakesDoWhereAddressesAreFew) {
  if (properties::sanitized) GTEST_SKIP() << "a sanitizer takes terabytes of addresses";
  EXPECT_EXIT(std::_Exit(appends_in_few_addresses() ? 0 : 1), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace catena
