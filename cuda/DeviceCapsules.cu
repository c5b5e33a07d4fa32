#include "catena/core/strategy/register.h"
#include "catena/cuda/capsule_search.cuh"

namespace catena::cuda {
namespace {

__global__ void __launch_bounds__(256) tell_tangled(const __grid_constant__ CapsuleBlocks blocks) {
  await_previous();
  const BlockMeeting meeting(blocks);
  for_each_of_mine(blocks.blocks, [&](std::uint32_t b) { meeting.tell_tangled(b); });
}

/// DeviceCapsules: capsules of 32 consecutive spheres in hashed cells, whatever the chain's order says; blocks
/// that meet too many others are searched among one another as in DeviceGrid.
template <class Arithmetic>
class DeviceCapsules final : public CapsuleSearch<Arithmetic> {
 public:
  explicit DeviceCapsules(const Parameters& parameters) : CapsuleSearch<Arithmetic>(parameters) {}

 private:
  CapsuleBlocks laid_out(const ChainView& chain, std::uint32_t crowd, float scale) const override {
    return CapsuleBlocks::in_cells_alone(chain, crowd, scale);
  }
  void enqueue_telling(const CapsuleBlocks& blocks, cudaStream_t stream) override {
    launch_next<tell_tangled>(std::min((blocks.blocks + 255) / 256, 1056u), 256, stream, blocks);
  }
};

const RegisterVariant<DeviceCapsules, Robust> registered{
    {.name = "DeviceCapsules",
     .summary = "capsules of 32 spheres in hashed cells, DeviceGrid where crowded",
     .place = Place::device(),
     .parameters = with_capsules({}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
