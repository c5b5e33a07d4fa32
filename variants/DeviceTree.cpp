#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/host_block_nodes.h"
#include "catena/core/cells/host_blocks.h"
#include "catena/core/cells/host_comparison.h"
#include "catena/core/cells/told_search.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// DeviceTree with its steps run on the host, one after the other, warps emulated.
template <class Arithmetic>
class DeviceTreeOnHost final : public HostSearch, public EvidenceNodes {
 public:
  explicit DeviceTreeOnHost(const Parameters& parameters) : range_(parameters) {}

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built() && any()) ToldTree(chain.view(), blocks_.blocks(), nodes_.nodes()).show(visitor);
  }

 private:
  Plan steps() const override { return range_.plan(); }
  bool any() const { return blocks_.blocks().blocks > 0; }

  void construct(const ChainView& chain) override {
    const CapsuleBlocks& all =
        blocks_.enclose(chain, CapsuleBlocks::in_tree_alone(chain, block_scale(chain.extent)));
    if (any()) nodes_.fit(all, BlockNodes::children);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    range_.template with_tests_for<Arithmetic>(chain, [&](auto tests) {
      if (any()) compare_blocks_in_tree<decltype(tests)>(chain, nodes_.nodes(), blocks_.blocks(), sink);
    });
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    if (any()) ToldTree(chain, blocks_.blocks(), nodes_.nodes()).search(lane, sink);
  }

  RangeChecks range_;
  HostBlocks blocks_;
  HostBlockNodes nodes_;
};

const RegisterVariant<DeviceTreeOnHost, Robust> registered{
    {.name = "DeviceTree@host",
     .summary = "capsules of 32 spheres in a tree of boxes along the chain",
     .parameters = {range_parameter()}}};

}  // namespace
}  // namespace catena
