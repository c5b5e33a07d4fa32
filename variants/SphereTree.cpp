#include "catena/core/blocks/told_exact.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/space_tree/told_order.h"
#include "catena/core/sphere_tree/sphere_kernels.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/strand_table.h"

namespace catena {
namespace {

/// SphereTree: single spheres along a space-filling curve by classes of size, sixteen a node, in boxes; those
/// of a node that another's box meets against vectors of the other's.
template <class Arithmetic>
class SpheresInSpace final : public HostSearch, public EvidenceNodes {
 public:
  explicit SpheresInSpace(const Parameters& parameters)
      : team_(parameters), strands_(parameters), queues_(team_.size()) {
    tree_.doubt = doubt_of(parameters);
  }

  std::vector<WorkDone> work() const override {
    const Done all = done();
    return {{"node, node", all.nodes - before_.nodes},
            {"sphere, vector of spheres", all.tests - before_.tests},
            {"pair of spheres, beyond binary32", all.open - before_.open}};
  }

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain&, BoundsVisitor& visitor) const override {
    if (built()) SphereNodes(tree_, spheres_).show(visitor);
  }

 private:
  Plan steps() const override {
    return {told_order(tree_.spheres, tree_.kept.frames()),
            told_exact(done().open - before_.open, tree_.doubt), strands_.told()};
  }
  void construct(const ChainView& chain) override {
    spheres_ = chain.size;
    build_sphere_tree(chain, tree_, {}, team_);
  }
  void construct_again(const ChainView& chain) override {
    build_sphere_tree(chain, tree_, {}, team_, SpaceSort::where_needed);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    before_ = done();
    search_sphere_tree(strands_.seen(chain), tree_, queues_, collector, team_);
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    const SphereNodes nodes(tree_, spheres_);
    search_sphere_tree(strands_.seen(chain), tree_, queues_[0], lane, SphereEvidence(chain, nodes, sink));
  }
  const Team& team() const override { return team_; }

  struct Done {
    std::uint64_t nodes = 0, tests = 0, open = 0;
  };
  Done done() const {
    Done all;
    for (const SphereQueues& queues : queues_)
      all.nodes += queues.nodes_done, all.tests += queues.tests_done, all.open += queues.open_done;
    return all;
  }

  const Team team_;
  StrandTable strands_;
  std::uint32_t spheres_ = 0;  // of the last build
  SphereTree tree_;
  std::vector<SphereQueues> queues_;  // [member of the team]
  Done before_;                       // the last search
};

const RegisterVariant<SpheresInSpace, Robust> registered{
    {.name = "SphereTree",
     .summary = "single spheres in the order of space, sixteen a node, SIMD",
     .parameters = {exact_parameter(), strands_parameter(), Team::threads_parameter()},
     .rival = [](std::uint32_t, const Extent&) { return 2; }}};

}  // namespace
}  // namespace catena
