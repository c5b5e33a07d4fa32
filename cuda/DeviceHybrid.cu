#include "catena/core/strategy/register.h"
#include "catena/cuda/capsule_search.cuh"
#include "catena/cuda/node_meetings.cuh"

namespace catena::cuda {
namespace {

/// DeviceHybrid: capsules of 32 consecutive spheres in a tree of boxes in the order of the chain; in hashed
/// cells where that says little of what is near; and blocks that meet too many others are searched among one
/// another as in DeviceGrid. Decided on the device, for each.
template <class Arithmetic>
class DeviceHybrid final : public CapsuleSearch<Arithmetic> {
 public:
  explicit DeviceHybrid(const Parameters& parameters)
      : CapsuleSearch<Arithmetic>(parameters),
        least_(parameters.unsigned_integer("least", 0, 0xFFFFFFFFu)),
        least_in_cells_(parameters.unsigned_integer("cells", 0, 0xFFFFFFFFu)),
        surveyed_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("survey", 0, CapsuleBlocks::most_surveyed))) {}

 private:
  CapsuleBlocks laid_out(const ChainView& chain, std::uint32_t crowd, float scale) const override {
    return CapsuleBlocks::of(chain, crowd, scale, least_, least_in_cells_, surveyed_);
  }
  void enqueue_telling(const CapsuleBlocks& blocks, cudaStream_t stream) override {
    nodes_.enqueue(blocks, stream);
  }

  const std::uint64_t least_, least_in_cells_;
  const std::uint32_t surveyed_;
  DeviceBlockNodes nodes_;
};

const RegisterVariant<DeviceHybrid, Robust> registered{
    {.name = "DeviceHybrid",
     .summary = "capsules of 32 spheres in a tree along the chain, in hashed cells where it is tangled, "
                "DeviceGrid where crowded",
     .place = Place::device(),
     .parameters = with_capsules(
         {{"least", "300000", "chains of fewer spheres are left to the grid"},
          {"cells", "4194304", "tangled blocks of chains of fewer spheres are left to the grid"},
          {"survey", "64",
           "blocks asked first whom they meet: the grid gets all where it takes less; 0: none"}}),
     .cost = Cost{.fixed_us = 140, .sphere_ns = 4.7, .start_ms = 300},
     .unavailable = unavailable,
     .started = started}};

}  // namespace
}  // namespace catena::cuda
