#include <cuda_runtime.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/cuda/call.h"
#include "catena/cuda/device.h"
#include "catena/properties/sorted_pairs.h"

namespace catena::properties {
namespace {

/// While it lives this process has so many bytes of the current device and no more, for what is allocated in
/// the order of a stream.
class LimitedMemory {
 public:
  explicit LimitedMemory(std::size_t bytes) {
    CATENA_CUDA(cudaGetDevice(&device_));
    CATENA_CUDA(cudaDeviceGetMemPool(&usual_, device_));
    cudaMemPoolProps limits{};
    limits.allocType = cudaMemAllocationTypePinned;
    limits.location.type = cudaMemLocationTypeDevice;
    limits.location.id = device_;
    limits.maxSize = bytes;
    CATENA_CUDA(cudaMemPoolCreate(&limited_, &limits));
    CATENA_CUDA(cudaDeviceSetMemPool(device_, limited_));
  }
  ~LimitedMemory() {
    cudaDeviceSetMemPool(device_, usual_);
    cudaMemPoolDestroy(limited_);
  }
  LimitedMemory(const LimitedMemory&) = delete;
  LimitedMemory& operator=(const LimitedMemory&) = delete;

 private:
  int device_ = 0;
  cudaMemPool_t usual_{}, limited_{};
};

class DeviceMemory : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = cuda::unavailable()) GTEST_SKIP() << *why;
  }
};

/// A block of spheres, each of which touches the next ones of six directions.
Chain block_of_spheres(int count) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i)
    spheres.push_back({static_cast<float>(i % 100), static_cast<float>(i / 100 % 100),
                       static_cast<float>(i / 10'000), 0.55f});
  return Chain(spheres);
}

/// nvcc has no code for that of Pair.
bool same(const Pair& a, const Pair& b) { return a.i == b.i && a.j == b.j; }

TEST_F(DeviceMemory, WhereItEndsAutoGoesOnInPartsOrOnTheHost) {
  const Chain chain = block_of_spheres(1'500'000);
  const auto host = StrategyRegistry::instance().make("Grid");
  Collisions expected;
  host->build(chain), host->find(chain, {}, expected);
  sort(expected.pairs);
  ASSERT_GT(expected.pair_count, 2'000'000u);
  const auto answered = [&](std::size_t bytes) {
    const LimitedMemory limit(bytes);
    const auto variant = StrategyRegistry::instance().make("auto(keep=device)");
    Collisions found;
    for (int twice = 0; twice < 2; ++twice) {  // the second time what has no room is known
      variant->build(chain), variant->find(chain, {}, found);
      sort(found.pairs);
      EXPECT_TRUE(std::ranges::equal(found.pairs, expected.pairs, same)) << bytes << " bytes";
      EXPECT_EQ(found.count, expected.count) << bytes << " bytes";
    }
    return variant->answered_by();
  };
  const std::string with_room = answered(std::size_t{4} << 30);
  EXPECT_TRUE(with_room.starts_with("Device") && with_room != "DeviceParts") << with_room;
  EXPECT_EQ(answered(std::size_t{96} << 20), "DeviceParts");
  const std::string without = answered(1);  // some: a pool has whole pages
  EXPECT_NE(without, with_room);
}

}  // namespace
}  // namespace catena::properties
