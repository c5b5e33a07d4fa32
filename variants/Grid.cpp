#include <string>

#include "catena/core/blocks/told_exact.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/grid/told_radii.h"
#include "catena/core/space_tree/search_cost.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/strand_table.h"

namespace catena {
namespace {

/// Grid: spheres in cells as wide as two of them, a level of cells for each octave of the radii; each against
/// half of its neighbourhood, a vector of candidates a test. Where little is near, in cells as wide as four
/// radii of which a sphere reaches but some, and each candidate in a lane of its own.
template <class Arithmetic>
class Grid final : public HostSearch, public EvidenceNodes {
 public:
  explicit Grid(const Parameters& parameters)
      : team_(parameters), strands_(parameters), queues_(team_.size()) {
    grid_.doubt = doubt_of(parameters);
    grid_.each_radius = reads_each_radius(parameters);
    cells_ = parameters.choice("cells", {"measured", "wide", "narrow"});
  }

  std::vector<WorkDone> work() const override {
    return {{"sphere, vector of spheres", done().tests - before_.tests},
            {"pair of spheres, beyond binary32", done().open - before_.open}};
  }

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) GridTrees(chain.view(), grid_, chain.size()).show(visitor);
  }

 private:
  Plan steps() const override {
    return {told_radii(grid_.equal_radii, grid_.spheres()),
            told_exact(done().open - before_.open, grid_.doubt), strands_.told()};
  }
  void construct(const ChainView& given) override {
    const ChainView chain = strands_.seen(given);
    grid_.wide = cells_ == "wide" || (cells_ == "measured" && wide_cells(chain));
    build_grid(chain, grid_, {}, team_);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    before_ = done();
    search_grid(strands_.seen(chain), grid_, queues_, collector, team_);
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    const GridTrees trees(chain, grid_, chain.size);
    GridEvidence evidence(chain, trees, sink);
    search_grid(strands_.seen(chain), grid_, queues_[0], lane, evidence);
  }
  const Team& team() const override { return team_; }

  struct Done {
    std::uint64_t tests = 0, open = 0;
  };
  Done done() const {
    Done all;
    for (const GridQueues& queues : queues_) all.tests += queues.tests_done, all.open += queues.open_done;
    return all;
  }

  const Team team_;
  StrandTable strands_;
  SphereGrid grid_;
  std::string cells_;               // as asked for
  std::vector<GridQueues> queues_;  // [member of the team]
  Done before_;                     // the last search
};

const RegisterVariant<Grid, Robust> registered{
    {.name = "Grid",
     .summary = "cells as wide as one or two spheres, half the neighbourhood each, SIMD",
     .parameters = {{"cells", "measured",
                     "as wide as four radii (wide) or two (narrow), or as a look at what is near tells"},
                    exact_parameter(),
                    radii_parameter(),
                    strands_parameter(),
                    Team::threads_parameter()},
     .rival = [](std::uint32_t, const Extent& e) {
       return e.greatest_radius <= 2 * e.least_radius ? 4 : 0;
     }}};

}  // namespace
}  // namespace catena
