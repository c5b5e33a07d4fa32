#include "catena/core/strategy/register.h"
#include "catena/cuda/capsule_search.cuh"
#include "catena/cuda/device.h"

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
  explicit DeviceCapsules(const Parameters& parameters)
      : CapsuleSearch<Arithmetic>(StrategyRegistry::instance().make_device(device_of(parameters)),
                                  parameters.unsigned_integer("binned", 0, 0xFFFFFFFFu)),
        crowd_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("crowd", 0, CapsuleBlocks::most_partners))) {}

 private:
  CapsuleBlocks laid_out(const ChainView& chain, float scale) const override {
    return CapsuleBlocks::in_cells_alone(chain, crowd_, scale);
  }
  void enqueue_telling(const CapsuleBlocks& blocks, cudaStream_t stream) override {
    launch_next<tell_tangled>(std::min((blocks.blocks + 255) / 256, 1056u), 256, stream, blocks);
  }

  const std::uint32_t crowd_;
};

const RegisterVariant<DeviceCapsules, Robust> registered{
    {.name = "DeviceCapsules",
     .summary = "capsules of 32 spheres in hashed cells, DeviceGrid where crowded",
     .place = Place::device(),
     .parameters =
         with_device({{"crowd", "8", "a block that meets more others is left to the grid"}, binned_parameter()}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
