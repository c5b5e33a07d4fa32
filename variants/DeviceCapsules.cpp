#include "catena/core/cells/host_capsule_search.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// DeviceCapsules with its steps run on the host.
template <class Arithmetic>
class DeviceCapsulesOnHost final : public HostCapsuleSearch<Arithmetic> {
 public:
  explicit DeviceCapsulesOnHost(const Parameters& parameters)
      : crowd_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("crowd", 0, CapsuleBlocks::most_partners))) {}

 private:
  CapsuleBlocks laid_out(const ChainView& chain, float scale) const override {
    return CapsuleBlocks::in_cells_alone(chain, crowd_, scale);
  }
  void tell(const CapsuleBlocks& blocks) override {
    const BlockMeeting meeting(blocks);
    for (std::uint32_t b = 0; b < blocks.blocks; ++b) meeting.tell_tangled(b);
  }

  const std::uint32_t crowd_;
};

const RegisterVariant<DeviceCapsulesOnHost, Robust> registered{
    {.name = "DeviceCapsules@host",
     .summary = "capsules of 32 spheres in hashed cells, DeviceGrid where crowded",
     .parameters = {{"crowd", "8", "a block that meets more others is left to the grid"}}}};

}  // namespace
}  // namespace catena
