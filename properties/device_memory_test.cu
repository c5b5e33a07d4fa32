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

Collisions answer_of_host(const Chain& chain) {
  const auto host = StrategyRegistry::instance().make("Grid");
  Collisions found;
  host->build(chain), host->find(chain, {}, found);
  sort(found.pairs);
  return found;
}

TEST_F(DeviceMemory, WhereItEndsAutoGoesOnInPartsOrOnTheHost) {
  const Chain chain = block_of_spheres(1'500'000);
  const Collisions expected = answer_of_host(chain);
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

/// Bins are faster, and need memory of their own: where there is none, cells are made without them, and where it is
/// all that was left for the answer, it is given back.
TEST_F(DeviceMemory, CellsAreMadeWithoutBinsWhereThereIsNoRoomForThem) {
  const Chain chain = block_of_spheres(4'000'000);
  const Collisions expected = answer_of_host(chain);
  ASSERT_GT(expected.pair_count, 5'000'000u);
  /// Whether so much memory was enough; the answer is right, then.
  const auto answered = [&](const char* name, std::size_t mib) {
    const LimitedMemory limit(mib << 20);
    const auto variant = StrategyRegistry::instance().make(name);
    Collisions found;
    try {
      variant->build(chain), variant->find(chain, {.want = Request::Want::counts}, found);
    } catch (const CapacityError&) {
      return false;
    }
    EXPECT_EQ(found.count, expected.count) << name << ", " << mib << " MiB";
    return true;
  };
  constexpr std::size_t step = 32, for_bins = 64;  // a pool grows by so much, and these spheres are so large
  std::size_t least = step;
  while (least < 4096 && !answered("DeviceGrid(binned=4294967295)", least)) least += step;
  ASSERT_GT(least, step);
  ASSERT_LT(least, 4096u);
  for (std::size_t mib = step; mib < least; mib += step)
    EXPECT_FALSE(answered("DeviceGrid(binned=0)", mib)) << mib;
  EXPECT_TRUE(answered("DeviceGrid(binned=0)", least)) << least;
  for (std::size_t mib = least + step; mib <= least + step + for_bins; mib += step)
    EXPECT_TRUE(answered("DeviceGrid(binned=0)", mib)) << least << ", " << mib;
}

}  // namespace
}  // namespace catena::properties
