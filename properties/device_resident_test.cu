#include <cuda_runtime.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/resident.h"
#include "catena/cuda/call.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/graph.h"
#include "catena/cuda/stream.h"
#include "catena/properties/testing/certified.h"
#include "catena/properties/testing/letters_of.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"

namespace catena::properties {
namespace {

/// A caller who has its chain, its stream and its buffers on the device.
class DeviceResident : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (const auto why = cuda::unavailable()) GTEST_SKIP() << *why;
    stream_ = std::make_unique<cuda::Stream>();
    device_ = StrategyRegistry::instance().make_device();
    variant_ = StrategyRegistry::instance().make(GetParam());
    ASSERT_NE(variant_->resident(), nullptr);
  }

  ResidentAnswer room_for(std::uint32_t n, std::uint64_t pairs) {
    return {count_.reserve(n, *stream_), pairs_.reserve(pairs, *stream_), pairs, state_.reserve(1, *stream_)};
  }
  void enqueue(const ChainView& chain, const ResidentAnswer& answer) {
    variant_->resident()->enqueue_build(chain, {}, static_cast<cudaStream_t>(*stream_));
    variant_->resident()->enqueue_find(chain, {}, answer, static_cast<cudaStream_t>(*stream_));
  }
  ResidentState state(const ResidentAnswer& answer) {
    ResidentState state{};
    CATENA_CUDA(cudaMemcpyAsync(&state, answer.state, sizeof state, cudaMemcpyDeviceToHost, *stream_));
    stream_->synchronize();
    return state;
  }
  Collisions fetched(const Chain& chain, const ResidentAnswer& answer) {
    Collisions found;
    found.pair_count = state(answer).found;
    found.found = found.pair_count > 0;
    found.count.resize(chain.size());
    found.pairs.resize(found.pair_count);
    CATENA_CUDA(cudaMemcpy(found.count.data(), answer.count, found.count.size() * sizeof(std::uint32_t),
                           cudaMemcpyDeviceToHost));
    CATENA_CUDA(cudaMemcpy(found.pairs.data(), answer.pairs, found.pairs.size() * sizeof(Pair),
                           cudaMemcpyDeviceToHost));
    return found;
  }
  static constexpr unsigned char guard = 0xA7;
  /// How many bytes of these on the device are not `guard`.
  template <class T>
  static std::size_t changed(const T* there, std::size_t count) {
    std::vector<unsigned char> bytes(count * sizeof(T));
    CATENA_CUDA(cudaMemcpy(bytes.data(), there, bytes.size(), cudaMemcpyDeviceToHost));
    return bytes.size() - static_cast<std::size_t>(std::ranges::count(bytes, guard));
  }

  std::unique_ptr<cuda::Stream> stream_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Variant> variant_;
  cuda::DeviceBuffer<std::uint32_t> count_;
  cuda::DeviceBuffer<Pair> pairs_;
  cuda::DeviceBuffer<ResidentState> state_;
};

const Chain& yarn() {
  static const Chain chain = open_input("yarn:n=3000").animation->frame(0);
  return chain;
}

TEST_P(DeviceResident, OverflowIsAFlagWithTheTrueNumberAndASecondCallMendsIt) {
  const auto exact = reference::find(yarn());
  ASSERT_GT(exact.pair_count, 100u);
  const ChainView chain = device_->to_device(yarn().view());
  const ResidentAnswer small = room_for(chain.size, 10);
  enqueue(chain, small);
  const ResidentState seen = state(small);
  EXPECT_NE(seen.overflow, 0u);
  EXPECT_EQ(seen.found, exact.pair_count);
  variant_->resident()->mend(seen);
  const ResidentAnswer enough = room_for(chain.size, seen.found);
  variant_->resident()->enqueue_find(chain, {}, enough, static_cast<cudaStream_t>(*stream_));
  EXPECT_EQ(state(enough).overflow, 0u);
  EXPECT_TRUE(reference::compare(yarn(), exact, fetched(yarn(), enough)).right());
}

TEST_P(DeviceResident, AnswersWhatIsAskedAlone) {
  const auto exact = reference::find(yarn());
  const Chain apart = open_input("rod:n=3000").animation->frame(0);
  ASSERT_EQ(reference::find(apart).pair_count, 0u);
  const auto asked = [&](const Chain& chain, Request::Want want) {
    const ChainView there = device_->to_device(chain.view());
    ResidentAnswer answer = room_for(there.size, 0);
    answer.pairs = nullptr;
    if (want == Request::Want::any) answer.count = nullptr;
    const Request request{.want = want};
    variant_->resident()->enqueue_build(there, request, static_cast<cudaStream_t>(*stream_));
    variant_->resident()->enqueue_find(there, request, answer, static_cast<cudaStream_t>(*stream_));
    const ResidentState seen = state(answer);
    EXPECT_EQ(seen.overflow, 0u);
    if (want == Request::Want::counts) {
      std::vector<std::uint32_t> count(chain.size());
      CATENA_CUDA(cudaMemcpy(count.data(), answer.count, count.size() * sizeof count[0], cudaMemcpyDeviceToHost));
      EXPECT_EQ(count, reference::find(chain).count);
    }
    return seen.found;
  };
  EXPECT_EQ(asked(yarn(), Request::Want::counts), exact.pair_count);
  EXPECT_GT(asked(yarn(), Request::Want::any), 0u);
  EXPECT_EQ(asked(apart, Request::Want::counts), 0u);
  EXPECT_EQ(asked(apart, Request::Want::any), 0u);
}

// Counts and pairs begin where the caller wants them, and nothing beside them is written.
TEST_P(DeviceResident, AnswersIntoBuffersThatBeginAnywhere) {
  const Chain odd = open_input("yarn:n=2999").animation->frame(0);
  const auto exact = reference::find(odd);
  ASSERT_GT(exact.pair_count, 100u);
  const ChainView chain = device_->to_device(odd.view());
  const std::size_t n = odd.size(), pairs = exact.pair_count, beside = 4;
  const ResidentAnswer whole = room_for(chain.size + 2 * beside, pairs + 2 * beside);
  for (std::size_t before = 0; before <= beside; ++before) {
    CATENA_CUDA(cudaMemsetAsync(whole.count, guard, (n + 2 * beside) * sizeof(std::uint32_t), *stream_));
    CATENA_CUDA(cudaMemsetAsync(whole.pairs, guard, (pairs + 2 * beside) * sizeof(Pair), *stream_));
    const ResidentAnswer answer{whole.count + before, whole.pairs + before, pairs, whole.state};
    enqueue(chain, answer);
    EXPECT_TRUE(reference::compare(odd, exact, fetched(odd, answer)).right()) << before;
    EXPECT_EQ(changed(whole.count, before), 0u) << before;
    EXPECT_EQ(changed(answer.count + n, 2 * beside - before), 0u) << before;
    EXPECT_EQ(changed(whole.pairs, before), 0u) << before;
    EXPECT_EQ(changed(answer.pairs + pairs, 2 * beside - before), 0u) << before;
  }
}

TEST_P(DeviceResident, IsCertifiedWhereItHasEvidence) {
  if (variant_->evidence() == Accounting::none) GTEST_SKIP() << "its twin on the host has the evidence";
  expect_certified(GetParam());
}

// What waits for the device cannot be captured: a graph proves that nothing does.
TEST_P(DeviceResident, IsPartOfACallersGraphWithoutWaiting) {
  const auto exact = reference::find(yarn());
  const ChainView chain = device_->to_device(yarn().view());
  const ResidentAnswer answer = room_for(chain.size, exact.pair_count);
  enqueue(chain, answer);  // takes its memory
  stream_->synchronize();
  const cuda::Graph graph(*stream_, [&] { enqueue(chain, answer); });
  for (int round = 0; round < 3; ++round) {
    CATENA_CUDA(cudaMemsetAsync(answer.pairs, 0xFF, exact.pair_count * sizeof(Pair), *stream_));
    graph.launch(*stream_);
    EXPECT_TRUE(reference::compare(yarn(), exact, fetched(yarn(), answer)).right()) << "round " << round;
  }
}

TEST_P(DeviceResident, AnswersByTheGraphThatIsTimed) {
  const auto exact = reference::find(yarn());
  const ChainView chain = device_->to_device(yarn().view());
  Collisions found;
  int runs = 0;
  const auto search = [&](const ResidentAnswer& answer, StreamHandle stream) {
    variant_->resident()->enqueue_build(chain, {}, stream);
    variant_->resident()->enqueue_find(chain, {}, answer, stream);
  };
  const auto times = device_->answer_by_graph(
      chain.size, {}, found, search, [&](const ResidentState& seen) { variant_->resident()->mend(seen); },
      [&] { device_->flush_cache(), ++runs; });
  EXPECT_GT(times.work_ms, 0);
  EXPECT_EQ(runs, 1);
  EXPECT_TRUE(reference::compare(yarn(), exact, found).right());
}

TEST_P(DeviceResident, AHostBuildAfterwardsIsOfTheHostsChain) {
  const auto exact = reference::find(yarn());
  const Chain other = open_input("path1:n=700").animation->frame(28);
  const ChainView chain = device_->to_device(other.view());
  enqueue(chain, room_for(chain.size, 1000));
  stream_->synchronize();
  ResidentSearch* const held = variant_->resident();
  Collisions found;
  EXPECT_THROW(variant_->find(yarn(), {}, found), std::logic_error);
  variant_->build(yarn());
  variant_->find(yarn(), {}, found);
  EXPECT_TRUE(reference::compare(yarn(), exact, found).right());
  held->enqueue_build(chain, {}, static_cast<cudaStream_t>(*stream_));
  EXPECT_THROW(variant_->find(yarn(), {}, found), std::logic_error);
  stream_->synchronize();
}

INSTANTIATE_TEST_SUITE_P(Device, DeviceResident,
                         testing::Values("GPU1", "aGPU2+GPU2", "aGPU2+GPUv2", "aGPU2+GPU2/double",
                                         "DeviceGrid", "DeviceGrid(binned=0)", "DeviceHybrid",
                                         // Its own kernels, which it leaves out of short chains, and all bins.
                                         "DeviceHybrid(least=0,survey=0)", "DeviceHybrid(least=0,survey=64)",
                                         "DeviceHybrid(least=0,cells=0,survey=0,binned=0)", "DeviceLBVH",
                                         "DeviceCapsules", "DeviceTree",
                                         "ResidentBlocks"),
                         [](const auto& info) { return letters_of(info.param); });

}  // namespace
}  // namespace catena::properties
