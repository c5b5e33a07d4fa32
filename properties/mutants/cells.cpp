#include <cstdint>
#include <limits>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/host_block_nodes.h"
#include "catena/core/cells/host_blocks.h"
#include "catena/core/cells/host_comparison.h"
#include "catena/core/cells/told_search.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/properties/mutants/mutant.h"

// Bugs of a search by cells in levels: which cells it looks into.
namespace catena::properties {
namespace {

/// Grid, its levels tampered with after the spheres were sorted.
class FaultyCells : public HostSearch, public EvidenceNodes {
 public:
  using Base = FaultyCells;
  explicit FaultyCells(bool wide = false) { grid_.wide = wide; }
  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) GridTrees(chain.view(), grid_, chain.size()).show(visitor);
  }

 private:
  virtual void tamper(SphereGrid::Level&) {}

  void construct(const ChainView& chain) override {
    build_grid(chain, grid_, {}, team());
    for (SphereGrid::Level& level : grid_.levels) tamper(level);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    search_grid(chain, grid_, {&queues_, 1}, collector, team());
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    const GridTrees trees(chain, grid_, chain.size);
    GridEvidence evidence(chain, trees, sink);
    search_grid(chain, grid_, queues_, lane, evidence);
  }

  SphereGrid grid_;
  GridQueues queues_;
};

template <bool wide>
class CellsOf : public FaultyCells {
 public:
  using Base = CellsOf;
  CellsOf() : FaultyCells(wide) {}
};

template <bool wide>
class HalfWithoutCorner final : public CellsOf<wide> {
  void tamper(SphereGrid::Level& level) override { level.half[3] = level.half[2]; }
};
const RegisterMutant<HalfWithoutCorner<false>> corner{
    "cells-forget-a-corner", "a half neighbourhood, one row of it twice and one never"};
const RegisterMutant<HalfWithoutCorner<true>> wide_corner{
    "wide-cells-forget-a-corner", "of the rows around wide cells one twice and one never"};

class NeverCoarser final : public FaultyCells {
  void tamper(SphereGrid::Level& level) override {
    constexpr float nowhere = std::numeric_limits<float>::infinity();
    level.centres.low = {nowhere, nowhere, nowhere};
  }
};
const RegisterMutant<NeverCoarser> never{"cells-never-look-into-coarser",
                                         "a finer level that is compared with itself alone"};

class LevelOfItsFirst final : public FaultyCells {
  void tamper(SphereGrid::Level& level) override { level.centres.high = level.centres.low; }
};
const RegisterMutant<LevelOfItsFirst> first{"cells-level-box-too-small",
                                            "a level whose box holds its lowest corner"};

class RowTwice final : public FaultyCells {
  void tamper(SphereGrid::Level& level) override { level.rows[8] = level.rows[7]; }
};
const RegisterMutant<RowTwice> row{"cells-look-into-a-row-twice",
                                   "a finer level that looks into eight rows of nine of a coarser one"};

template <bool wide>
class OwnReach final : public CellsOf<wide> {
  void tamper(SphereGrid::Level& level) override { level.greatest = 0; }
};
const RegisterMutant<OwnReach<false>> reach{
    "cells-reach-without-the-other", "a look into coarser cells that forgets how large their spheres are"};
const RegisterMutant<OwnReach<true>> wide_reach{"wide-cells-reach-without-the-other",
                                                "the cells that a sphere reaches, told by its own radius"};

/// DeviceGrid's twin, its cells tampered with after the spheres were placed.
class FaultyHashedCells : public HostSearch, public EvidenceNodes {
 public:
  using Base = FaultyHashedCells;
  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) ToldCells(chain.view(), nullptr, placed_).show(visitor);
  }

 private:
  virtual void tamper(PlacedCells&) {}

  void construct(const ChainView& chain) override {
    cells_.build(chain, chain.size, [](std::uint32_t) { return true; });
    placed_ = cells_.placed();
    tamper(placed_);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    with_tests_for<Robust>(chain, [&](auto tests) { placed_.search<decltype(tests)>(chain, sink); });
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    ToldCells(chain, nullptr, placed_).search(lane, sink);
  }

  HostSphereCells cells_;
  PlacedCells placed_;
};

class HashedRowTwice final : public FaultyHashedCells {
  void tamper(PlacedCells& placed) override { placed.table.step[8] = placed.table.step[7]; }
};
const RegisterMutant<HashedRowTwice> hashed{"hashed-cells-look-into-a-row-twice",
                                            "eight rows of nine, and one of them twice"};

/// Who is of the coarsest octave is not looked for.
class CoarsestLost final : public FaultyHashedCells {
  void tamper(PlacedCells& placed) override {
    if (placed.cells.one_level()) return;
    for (std::uint32_t& levels : placed.cells.state->levels)
      if (levels != 0) {
        levels &= levels - 1;
        return;
      }
  }
};
const RegisterMutant<CoarsestLost> coarsest{"hashed-cells-forget-the-coarsest",
                                            "levels counted from one, and the first is number nought"};

/// DeviceTree's twin, its boxes tampered with after they were fitted.
class FaultyBlockTree : public HostSearch, public EvidenceNodes {
 public:
  using Base = FaultyBlockTree;
  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built() && any()) ToldTree(chain.view(), blocks_.blocks(), nodes_.nodes()).show(visitor);
  }

 private:
  virtual void tamper(NodeBox&) {}
  bool any() const { return blocks_.blocks().blocks > 0; }

  void construct(const ChainView& chain) override {
    const CapsuleBlocks& all =
        blocks_.enclose(chain, CapsuleBlocks::in_tree_alone(chain, block_scale(chain.extent)));
    if (!any()) return;
    const BlockNodes& nodes = nodes_.fit(all, BlockNodes::children);
    for (std::uint32_t k = 0; k < nodes.count[1]; ++k) {
      NodeBox box = nodes.box(1, k);
      tamper(box);
      nodes.put(1, k, box);
    }
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    with_tests_for<Robust>(chain, [&](auto tests) {
      if (any()) compare_blocks_in_tree<decltype(tests)>(chain, nodes_.nodes(), blocks_.blocks(), sink);
    });
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    if (any()) ToldTree(chain, blocks_.blocks(), nodes_.nodes()).search(lane, sink);
  }

  HostBlocks blocks_;
  HostBlockNodes nodes_;
};

class HalfABox final : public FaultyBlockTree {
  void tamper(NodeBox& box) override { box.half[0] *= 0.5f; }
};
const RegisterMutant<HalfABox> shortened{"block-tree-box-too-short",
                                         "boxes of nodes half as long as they are"};

/// All nodes are taken for stretches that cannot touch themselves.
class AllInARow final : public FaultyBlockTree {
  void tamper(NodeBox& box) override { box.in_a_row = 1; }
};
const RegisterMutant<AllInARow> in_a_row{"block-tree-always-in-a-row",
                                         "children that are taken to follow one another along the box"};

}  // namespace
}  // namespace catena::properties
