#include <gtest/gtest.h>

#include <memory>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/cuda/device_blocks.cuh"
#include "catena/cuda/host_copies.cuh"
#include "catena/cuda/node_meetings.cuh"
#include "catena/cuda/stream.h"
#include "catena/properties/testing/look_on_host.h"
#include "catena/properties/testing/no_device.h"

// The first look at a chain's blocks, which no answer depends on: a device sees what the host does, and one build
// nothing of the build before.
namespace catena::properties {
namespace {

class DeviceLook : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = no_device()) GTEST_SKIP() << *why;
    stream_ = std::make_unique<cuda::Stream>();
    device_ = StrategyRegistry::instance().make_device();
  }
  /// Whether a chain is left to the grid at once; as on the host.
  bool left(const char* scene) {
    const Chain chain = open_input(scene).animation->frame(0);
    const auto laid_out = CapsuleBlocks::of(chain.view(), 8, block_scale(chain.view().extent), 0, ~0u, 64);
    const LookOnHost host = look_on_host(chain.view(), laid_out);

    const cudaStream_t stream = *stream_;
    const ChainView there = device_->to_device(chain.view());
    CapsuleBlocks blocks = of_device_.reserve(laid_out, state_.reserve(1, stream), stream);
    of_device_.reserve_cells(blocks, stream);
    EXPECT_NE(blocks.look, nullptr);
    cuda::DeviceBlocks::enqueue_enclose(there, blocks, blocks.state, stream);
    const CapsuleBlocks::Look seen = cuda::fetched(blocks.look, 1, stream)[0];
    for (std::uint32_t k = 0; k < CapsuleBlocks::Look::words; ++k) {
      EXPECT_EQ(seen.met[k], host.saw.met[k]) << scene << ' ' << k;
      EXPECT_EQ(seen.tangled[k], host.saw.tangled[k]) << scene << ' ' << k;
    }
    nodes_.enqueue(blocks, stream);
    const CapsuleBlocks::Look then = cuda::fetched(blocks.look, 1, stream)[0];
    for (std::uint32_t k = 0; k < CapsuleBlocks::Look::words; ++k) EXPECT_EQ(then.met[k] | then.tangled[k], 0u) << scene;
    CapsuleBlocks::State state = cuda::fetched(blocks.state, 1, stream)[0];
    EXPECT_EQ(CapsuleBlocks::Survey::of(state.survey).asked, 64u) << scene;  // also who is not left is asked then
    if (host.said.asked > 0) {
      EXPECT_EQ(state.survey, host.said.number()) << scene;
    }
    return host.said.asked > 0;
  }

 private:
  std::unique_ptr<cuda::Stream> stream_;
  std::unique_ptr<Device> device_;
  cuda::DeviceBlocks of_device_;
  cuda::DeviceBlockNodes nodes_;
  cuda::DeviceBuffer<CapsuleBlocks::State> state_;
};

TEST_F(DeviceLook, SeesWhatTheHostSeesAndForgetsIt) {
  for (int round = 0; round < 2; ++round) {
    EXPECT_TRUE(left("yarn:n=40000"));
    EXPECT_FALSE(left("path1:n=40001"));
    EXPECT_TRUE(left("walk:n=8192"));
    EXPECT_FALSE(left("path2:n=300000"));
    EXPECT_TRUE(left("coil:n=100007"));
    EXPECT_FALSE(left("torus_knot:n=1000000"));
  }
}

}  // namespace
}  // namespace catena::properties
