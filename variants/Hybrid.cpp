#include <fmt/format.h>

#include "catena/core/blocks/told_exact.h"
#include "catena/core/blocks/told_rows.h"
#include "catena/core/counted.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/grid/told_radii.h"
#include "catena/core/hybrid/hybrid_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/strand_table.h"

namespace catena {
namespace {

/// Hybrid: blocks of eight spheres in the chain's order where that says what is near, in the order of space
/// where it does not, and single spheres where much is near; see HybridSearch.
template <class Arithmetic>
class Hybrid final : public HostSearch, public EvidenceNodes {
 public:
  explicit Hybrid(const Parameters& parameters)
      : team_(parameters),
        strands_(parameters),
        search_({static_cast<std::uint32_t>(parameters.unsigned_integer("crowd", 0, 1u << 20)),
                 parameters.real("dense", 0, 1e6), skips_rows(parameters), doubt_of(parameters),
                 reads_each_radius(parameters)},
                team_.size()) {}

  std::vector<WorkDone> work() const override {
    const HybridSearch::Work work = search_.work();
    return {{"block, sixteen blocks", work.rows},      {"two blocks in space", work.entries},
            {"eight spheres, eight", work.near},       {"sixteen spheres, sixteen", work.sixteens},
            {"sphere, vector of spheres", work.tests}, {"pair of spheres, beyond binary32", work.open}};
  }

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) search_.show_evidence(chain.view(), visitor);
  }

 private:
  Plan steps() const override {
    const HybridSearch::Work work = search_.work();
    Plan steps{search_.told_rows(),
               {"order of space", search_.crowded_nodes() == 0,
                fmt::format("{} of {} nodes of 128 spheres meet more than {} others, or have much near them",
                            search_.crowded_nodes(), search_.nodes(), search_.settings().crowd)}};
    if (search_.sorts()) steps.push_back(search_.told_order());
    steps.push_back(
        {"single spheres", work.dense == 0, fmt::format("{} with much near", counted(work.dense, "sphere"))});
    steps.push_back(told_radii(search_.equal_radii(), work.dense));
    steps.push_back(told_exact(work.open, search_.settings().doubt));
    steps.push_back(strands_.told());
    return steps;
  }
  void construct(const ChainView& chain) override { search_.build(strands_.seen(chain), team_); }
  void construct_again(const ChainView& chain) override {
    search_.build(strands_.seen(chain), team_, SpaceSort::where_needed);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    search_.search(strands_.seen(chain), collector, team_);
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    search_.search_with_evidence(strands_.seen(chain), lane, sink);
  }
  const Team& team() const override { return team_; }

  const Team team_;
  StrandTable strands_;
  HybridSearch search_;
};

const RegisterVariant<Hybrid, Robust> registered{
    {.name = "Hybrid",
     .summary =
         "blocks of eight spheres in the chain's order or in that of space, single ones where much is near",
     .parameters = {{"crowd", "64", "a node of 128 spheres that meets more others leaves the chain's order"},
                    {"dense", "1",
                     "a block that costs more than so many times its spheres one by one is parted into them"},
                    rows_parameter(),
                    exact_parameter(),
                    radii_parameter(),
                    strands_parameter(),
                    Team::threads_parameter()},
     .cost = Cost{.fixed_us = 0.8, .sphere_ns = 6},
     .rival = [](std::uint32_t, const Extent&) { return 3; }}};

}  // namespace
}  // namespace catena
