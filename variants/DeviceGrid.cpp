#include "catena/core/cells/host_sphere_cells.h"
#include "catena/core/cells/told_search.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// DeviceGrid with its steps run on the host, one after the other.
template <class Arithmetic>
class DeviceGridOnHost final : public HostSearch, public EvidenceNodes {
 public:
  explicit DeviceGridOnHost(const Parameters& parameters) : range_(parameters) {}

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) ToldCells(chain.view(), nullptr, cells_.placed()).show(visitor);
  }

 private:
  Plan steps() const override { return range_.plan(); }
  void construct(const ChainView& chain) override {
    cells_.build(chain, chain.size, [](std::uint32_t) { return true; });
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    range_.with_tests_for<Arithmetic>(
        chain, [&](auto tests) { cells_.placed().search<decltype(tests)>(chain, sink); });
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    ToldCells(chain, nullptr, cells_.placed()).search(lane, sink);
  }

  HostSphereCells cells_;
  RangeChecks range_;
};

const RegisterVariant<DeviceGridOnHost, Robust> registered{
    {.name = "DeviceGrid@host",
     .summary = "spheres in hashed cells, an octave of radii a level",
     .parameters = {range_parameter()}}};

}  // namespace
}  // namespace catena
