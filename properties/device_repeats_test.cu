#include <cuda_runtime.h>
#include <gtest/gtest.h>

#include <cub/block/block_reduce.cuh>
#include <string>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/resident.h"
#include "catena/cuda/call.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/launch.cuh"
#include "catena/cuda/stream.h"
#include "catena/properties/testing/letters_of.h"

// What depends on the order in which threads come loses a pair once in many runs, if ever.
namespace catena::properties {
namespace {

constexpr unsigned hash_threads = 256;

/// Of a pair, the order of whose spheres says nothing; splitmix64.
__host__ __device__ unsigned long long hash_of(const Pair& pair) {
  const std::uint32_t low = pair.i < pair.j ? pair.i : pair.j, high = pair.i < pair.j ? pair.j : pair.i;
  unsigned long long x = (static_cast<unsigned long long>(low) << 32 | high) + 0x9E3779B97F4A7C15;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9;
  x = (x ^ x >> 27) * 0x94D049BB133111EB;
  return x ^ x >> 31;
}

/// Adds to `sum` the hashes of the pairs that a search found: the same for every order of them.
__global__ void add_hashes(const Pair* pairs, const ResidentState* state, unsigned long long* sum) {
  using Sum = cub::BlockReduce<unsigned long long, hash_threads>;
  __shared__ typename Sum::TempStorage room;
  unsigned long long own = 0;
  for (std::uint64_t k = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x; k < state->found;
       k += std::uint64_t{gridDim.x} * blockDim.x)
    own += hash_of(pairs[k]);
  const unsigned long long all = Sum(room).Sum(own);
  if (threadIdx.x == 0) atomicAdd(sum, all);
}

Chain yarn(std::uint32_t n) { return open_input("yarn:n=" + std::to_string(n)).animation->frame(0); }

/// Half laid out along the yarn's middle, half yarn.
Chain mixed(std::uint32_t n) {
  const Chain tangled = yarn(n / 2);
  std::vector<Sphere> spheres(tangled.spheres().begin(), tangled.spheres().end());
  const float radius = spheres.front().radius;
  for (std::uint32_t k = 0; k < n / 2; ++k)
    spheres.push_back(
        {1.6f * radius * (static_cast<float>(k) - 0.25f * static_cast<float>(n)), 0, 0, radius});
  return Chain(std::move(spheres));
}

class DeviceRepeats : public testing::TestWithParam<const char*> {};

TEST_P(DeviceRepeats, OfTenMillionSpheresAreAThousandTimesTheSame) {
  if (const auto why = cuda::unavailable()) GTEST_SKIP() << *why;
  const std::string kind = GetParam();
  constexpr std::uint32_t n = 10'000'000;
  const Chain chain = kind == "yarn" ? yarn(n) : mixed(n);
  const auto host = StrategyRegistry::instance().make("Hybrid(threads=0)"),
             variant = StrategyRegistry::instance().make("DeviceHybrid");
  Collisions right;
  host->build(chain), host->find(chain, {}, right);
  ASSERT_GT(right.pair_count, n);
  unsigned long long right_hash = 0;
  for (const Pair& pair : right.pairs) right_hash += hash_of(pair);

  const cuda::Stream stream;
  const auto device = StrategyRegistry::instance().make_device();
  const ChainView there = device->to_device(chain.view());
  cuda::DeviceBuffer<std::uint32_t> counts;
  cuda::DeviceBuffer<Pair> pairs;
  cuda::DeviceBuffer<ResidentState> states;
  cuda::DeviceBuffer<unsigned long long> hashes;
  const ResidentAnswer answer{counts.reserve(n, stream), pairs.reserve(right.pair_count, stream),
                              right.pair_count, states.reserve(1, stream)};
  unsigned long long* const hash = hashes.reserve(1, stream);
  std::vector<std::uint32_t> count(n);
  for (int round = 0; round < 1000; ++round) {
    variant->resident()->enqueue_build(there, {}, static_cast<cudaStream_t>(stream));
    variant->resident()->enqueue_find(there, {}, answer, static_cast<cudaStream_t>(stream));
    CATENA_CUDA(cudaMemsetAsync(hash, 0, sizeof *hash, stream));
    cuda::launch_blocks(add_hashes, 1024, hash_threads, stream, answer.pairs, answer.state, hash);
    ResidentState seen{};
    unsigned long long found_hash = 0;
    CATENA_CUDA(cudaMemcpyAsync(&seen, answer.state, sizeof seen, cudaMemcpyDeviceToHost, stream));
    CATENA_CUDA(cudaMemcpyAsync(&found_hash, hash, sizeof found_hash, cudaMemcpyDeviceToHost, stream));
    CATENA_CUDA(
        cudaMemcpyAsync(count.data(), answer.count, n * sizeof count[0], cudaMemcpyDeviceToHost, stream));
    stream.synchronize();
    ASSERT_EQ(seen.overflow, 0u) << "round " << round;
    ASSERT_EQ(seen.found, right.pair_count) << "round " << round;
    ASSERT_EQ(found_hash, right_hash) << "round " << round;
    ASSERT_TRUE(count == right.count) << "round " << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Device, DeviceRepeats, testing::Values("yarn", "mixed"),
                         [](const auto& info) { return letters_of(info.param); });

}  // namespace
}  // namespace catena::properties
