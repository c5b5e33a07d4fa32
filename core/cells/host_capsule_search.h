#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/host_blocks.h"
#include "catena/core/cells/host_comparison.h"
#include "catena/core/cells/host_sphere_cells.h"
#include "catena/core/cells/told_search.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/range_checks.h"

namespace catena {

/// Capsules of 32 consecutive spheres, tangled ones in cells and crowded ones left to the grid of spheres:
/// the steps of a device's search run on the host, one after the other, warps emulated. Who derives says how
/// blocks are laid out and what is tangled.
template <class Arithmetic>
class HostCapsuleSearch : public HostSearch, public EvidenceNodes {
 public:
  explicit HostCapsuleSearch(const Parameters& parameters)
      : range_(parameters),
        crowd_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("crowd", 0, CapsuleBlocks::most_partners))) {}

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) ToldCells(chain.view(), &blocks_.blocks(), cells_.placed()).show(visitor);
  }

 protected:
  /// How blocks of a chain are laid out, at `scale`; a block that meets more than `crowd` others is crowded.
  virtual CapsuleBlocks laid_out(const ChainView& chain, std::uint32_t crowd, float scale) const = 0;
  /// Tells of every block, of which there is one and whose capsules are known, whom it meets, or that it is
  /// tangled (BlockMeeting::tell).
  virtual void tell(const CapsuleBlocks& blocks) = 0;

 private:
  Plan steps() const override {
    Plan plan = range_.plan();
    const CapsuleBlocks& all = blocks_.blocks();
    std::uint32_t crowded = all.all_crowded ? all.blocks : 0, tangled = 0;
    for (std::uint32_t b = 0; !all.all_crowded && b < all.blocks; ++b)
      crowded += all.crowded(b), tangled += all.tangled(b);
    plan.push_back({"capsules in cells", tangled == 0,
                    fmt::format("{} of {} blocks of 32 spheres are tangled", tangled, all.blocks)});
    plan.push_back({"grid of spheres", crowded == 0,
                    fmt::format("{} of {} blocks of 32 spheres are crowded", crowded, all.blocks)});
    return plan;
  }
  void construct(const ChainView& chain) override {
    const CapsuleBlocks& all = blocks_.enclose(chain, laid_out(chain, crowd_, block_scale(chain.extent)));
    if (all.all_crowded) return cells_.build(chain, chain.size, [](std::uint32_t) { return true; });
    if (all.blocks > 0) tell(all);
    blocks_.meet_in_cells();
    cells_.build(chain, all.crowded_spheres(),
                 [&](std::uint32_t i) { return all.crowded(i / CapsuleBlocks::block); });
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    range_.template with_tests_for<Arithmetic>(chain, [&](auto tests) {
      compare_blocks<decltype(tests)>(chain, blocks_.blocks(), sink);
      cells_.placed().search<decltype(tests)>(chain, sink);
    });
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    ToldCells(chain, &blocks_.blocks(), cells_.placed()).search(lane, sink);
  }

  RangeChecks range_;
  const std::uint32_t crowd_;
  HostBlocks blocks_;
  HostSphereCells cells_;
};

/// The parameters of such a search, which has these of its own.
inline std::vector<ParameterInfo> with_capsules_on_host(std::vector<ParameterInfo> own) {
  own.insert(own.begin(), {"crowd", "8", "a block that meets more others is left to the grid"});
  own.push_back(range_parameter());
  return own;
}

}  // namespace catena
