#include "catena/core/cells/find_partners.h"
#include "catena/core/cells/host_block_nodes.h"
#include "catena/core/cells/host_capsule_search.h"
#include "catena/core/cells/survey_blocks.h"
#include "catena/core/executor/host_group.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// DeviceHybrid with its steps run on the host.
template <class Arithmetic>
class DeviceHybridOnHost final : public HostCapsuleSearch<Arithmetic> {
 public:
  explicit DeviceHybridOnHost(const Parameters& parameters)
      : HostCapsuleSearch<Arithmetic>(parameters),
        least_(parameters.unsigned_integer("least", 0, 0xFFFFFFFFu)),
        least_in_cells_(parameters.unsigned_integer("cells", 0, 0xFFFFFFFFu)),
        surveyed_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("survey", 0, CapsuleBlocks::most_surveyed))) {}

 private:
  CapsuleBlocks laid_out(const ChainView& chain, std::uint32_t crowd, float scale) const override {
    return CapsuleBlocks::of(chain, crowd, scale, least_, least_in_cells_, surveyed_);
  }
  void tell(const CapsuleBlocks& blocks) override {
    const BlockNodes& nodes = nodes_.fit(blocks);
    HostGroup group(32);
    for (std::uint32_t k = 0; k < blocks.surveyed && !blocks.surveyed_all(); ++k)
      BlockSurvey(nodes, blocks, of_survey_).ask(group, k);
    for (std::uint32_t k = 0; k < nodes.count[2]; ++k)
      PartnerSearch(nodes, blocks, of_search_).find(group, k);
  }

  const std::uint64_t least_, least_in_cells_;
  const std::uint32_t surveyed_;
  HostBlockNodes nodes_;
  BlockSurvey::Memory of_survey_{};
  PartnerSearch::Memory of_search_{};
};

const RegisterVariant<DeviceHybridOnHost, Robust> registered{
    {.name = "DeviceHybrid@host",
     .summary = "capsules of 32 spheres in a tree along the chain, in hashed cells where it is tangled, "
                "DeviceGrid where crowded",
     .parameters = with_capsules_on_host(
         {{"least", "0", "chains of fewer spheres are left to the grid; DeviceHybrid: 300000"},
          {"cells", "0",
           "tangled blocks of chains of fewer spheres are left to the grid; DeviceHybrid: 4194304"},
          {"survey", "64",
           "blocks asked first whom they meet: the grid gets all where it takes less; 0: none"}})}};

}  // namespace
}  // namespace catena
