#include "catena/core/made_once.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace catena {
namespace {

TEST(MadeOnce, MakesItForTheFirstThatAsks) {
  const MadeOnce<std::vector<int>> value;
  int made = 0;
  const auto make = [&] {
    ++made;
    return std::vector<int>(3, made);
  };
  EXPECT_THROW(value.by([]() -> std::vector<int> { throw std::runtime_error("not yet"); }),
               std::runtime_error);
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] { EXPECT_EQ(value.by(make), (std::vector<int>{1, 1, 1})); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
}

}  // namespace
}  // namespace catena
