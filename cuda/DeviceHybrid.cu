#include <algorithm>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/resident_variant.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_sphere_cells.cuh"
#include "catena/cuda/device_warp.cuh"

namespace catena::cuda {
namespace {

constexpr unsigned threads = 128, warps = threads / 32;

__device__ std::uint32_t own_block() { return blockIdx.x * warps + threadIdx.x / 32; }

__global__ void __launch_bounds__(threads)
    enclose_blocks(const __grid_constant__ ChainView chain, const __grid_constant__ CapsuleBlocks blocks) {
  const DeviceWarp warp;
  if (own_block() < blocks.blocks) BlockMeeting(warp, chain, blocks).enclose(own_block());
}

__global__ void __launch_bounds__(threads, 12)
    meet_blocks(const __grid_constant__ ChainView chain, const __grid_constant__ CapsuleBlocks blocks) {
  const DeviceWarp warp;
  if (own_block() < blocks.blocks) BlockMeeting(warp, chain, blocks).meet(own_block());
}

/// The warps of a thread block share the work of 32 blocks: most have none, and some have much.
template <class Tests>
__global__ void __launch_bounds__(threads)
    compare_blocks(const __grid_constant__ ChainView chain, const __grid_constant__ CapsuleBlocks blocks,
                   const __grid_constant__ ResidentAnswer answer, SphereRange queries) {
  using Work = BlockMeeting<DeviceWarp>::Work;
  constexpr std::uint32_t together = 32, kinds = static_cast<std::uint32_t>(Work::kinds);
  __shared__ struct { std::uint8_t block, work; } item[together * kinds];
  __shared__ std::uint32_t items;
  __shared__ PairStage::Shared shared;
  const DeviceWarp warp;
  const BlockMeeting meeting(warp, chain, blocks);
  const std::uint32_t first = blockIdx.x * together, b = first + threadIdx.x;
  if (threadIdx.x == 0) items = 0;
  PairStage stage(shared, answer, queries);
  __syncthreads();
  if (threadIdx.x < together && b < blocks.blocks)
    meeting.plan(b, [&](Work work) {
      item[atomicAdd(&items, 1u)] = {static_cast<std::uint8_t>(threadIdx.x), static_cast<std::uint8_t>(work)};
    });
  __syncthreads();
  if (items == 0 || stage.satisfied()) return;
  for (std::uint32_t k = threadIdx.x / 32; k < items; k += warps)
    meeting.template compare<Tests>(first + item[k].block, static_cast<Work>(item[k].work), stage);
  stage.flush();
}

/// The spheres of crowded blocks, for the grid of spheres.
struct CrowdedSpheres {
  CapsuleBlocks blocks;
  __device__ bool any() const { return blocks.state->any != 0; }
  __device__ bool takes(std::uint32_t i) const { return blocks.crowded(i / CapsuleBlocks::block); }
  __device__ std::uint32_t expected() const { return blocks.crowded_spheres(); }
};

/// DeviceHybrid: capsules of 32 consecutive spheres in hashed cells; blocks that meet too many others,
/// decided on the device for each, are searched among one another as in DeviceGrid.
template <class Arithmetic>
class DeviceHybrid final : public ResidentVariant {
 public:
  explicit DeviceHybrid(const Parameters& parameters)
      : ResidentVariant(StrategyRegistry::instance().make_device(device_of(parameters))),
        crowd_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("crowd", 0, CapsuleBlocks::most_partners))) {}

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

 private:
  void enqueue_build(const ChainView& chain, const Request&, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    lay_out(chain, stream);
    launch_blocks(enclose_blocks, thread_blocks(), threads, stream, chain, blocks_);
    launch_blocks(meet_blocks, thread_blocks(), threads, stream, chain, blocks_);
    cells_.enqueue_build(chain, {blocks_}, stream);
  }

  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      launch_blocks(compare_blocks<decltype(tests)>, (blocks_.blocks + 31) / 32, threads, stream, chain,
                    blocks_, answer, request.queries.within(chain.size));
      cells_.template enqueue_search<decltype(tests)>(chain, request, answer, stream);
    });
    in_range_ = in_range<Arithmetic>(chain);
  }

  unsigned thread_blocks() const { return (blocks_.blocks + warps - 1) / warps; }

  void lay_out(const ChainView& chain, cudaStream_t stream) {
    blocks_ = CapsuleBlocks::of(chain, crowd_, block_scale(chain.extent));
    const std::size_t n = blocks_.blocks, buckets = blocks_.table.buckets;
    blocks_.capsule = capsule_.reserve(n, stream);
    blocks_.shape = shape_.reserve(n, stream);
    blocks_.partners = partners_.reserve(n, stream);
    blocks_.partner = partner_.reserve(CapsuleBlocks::most_partners * n, stream);
    blocks_.bucket = bucket_.reserve(CapsuleBlocks::slots * buckets, stream);
    // What is 0 at first lies together.
    constexpr std::size_t of_state = sizeof(CapsuleBlocks::State) / sizeof(std::uint32_t);
    const std::size_t zeros = of_state + n + buckets;
    std::uint32_t* const zero = zero_.reserve(zeros, stream);
    CATENA_CUDA(cudaMemsetAsync(zero, 0, zeros * sizeof *zero, stream));
    blocks_.state = reinterpret_cast<CapsuleBlocks::State*>(zero);
    blocks_.met = zero + of_state;
    blocks_.in_bucket = blocks_.met + n;
  }

  const std::uint32_t crowd_;
  CapsuleBlocks blocks_{};
  DeviceBuffer<BlockCapsule> capsule_;
  DeviceBuffer<std::uint8_t> shape_, partners_;
  DeviceBuffer<std::uint32_t> partner_, bucket_, zero_;
  DeviceSphereCells<CrowdedSpheres> cells_;
  bool in_range_ = false;  ///< of the last search
};

const RegisterVariant<DeviceHybrid, Robust> registered{
    {.name = "DeviceHybrid",
     .summary = "capsules of 32 spheres in hashed cells, and DeviceGrid where they are crowded",
     .place = Place::device(),
     .parameters = with_device({{"crowd", "8", "a block that meets more others is left to the grid"}}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
