#include "catena/core/cells/host_capsule_search.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// DeviceCapsules with its steps run on the host.
template <class Arithmetic>
class DeviceCapsulesOnHost final : public HostCapsuleSearch<Arithmetic> {
 public:
  using HostCapsuleSearch<Arithmetic>::HostCapsuleSearch;

 private:
  CapsuleBlocks laid_out(const ChainView& chain, std::uint32_t crowd, float scale) const override {
    return CapsuleBlocks::in_cells_alone(chain, crowd, scale);
  }
  void tell(const CapsuleBlocks& blocks) override {
    const BlockMeeting meeting(blocks);
    for (std::uint32_t b = 0; b < blocks.blocks; ++b) meeting.tell_tangled(b);
  }
};

const RegisterVariant<DeviceCapsulesOnHost, Robust> registered{
    {.name = "DeviceCapsules@host",
     .summary = "capsules of 32 spheres in hashed cells, DeviceGrid where crowded",
     .parameters = with_capsules_on_host({})}};

}  // namespace
}  // namespace catena
