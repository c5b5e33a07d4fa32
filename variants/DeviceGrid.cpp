#include "catena/core/arithmetic/in_range.h"
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
  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }
  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) ToldCells(chain.view(), nullptr, cells_.placed()).show(visitor);
  }

 private:
  void construct(const ChainView& chain) override {
    cells_.build(chain, chain.size, [](std::uint32_t) { return true; });
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    with_tests_for<Arithmetic>(chain,
                               [&](auto tests) { cells_.placed().search<decltype(tests)>(chain, sink); });
    in_range_ = in_range<Arithmetic>(chain);
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    ToldCells(chain, nullptr, cells_.placed()).search(lane, sink);
  }

  HostSphereCells cells_;
  bool in_range_ = false;
};

const RegisterVariant<DeviceGridOnHost, Robust> registered{
    {.name = "DeviceGrid@host", .summary = "spheres in hashed cells, an octave of radii a level"}};

}  // namespace
}  // namespace catena
