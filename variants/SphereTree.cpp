#include "catena/core/executor/host_search.h"
#include "catena/core/sphere_tree/sphere_kernels.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// SphereTree: single spheres along a space-filling curve by classes of size, sixteen a node, in boxes; those
/// of a node that another's box meets against vectors of the other's.
template <class Arithmetic>
class SpheresInSpace final : public HostSearch, public EvidenceNodes {
 public:
  explicit SpheresInSpace(const Parameters& parameters) : team_(parameters), queues_(team_.size()) {}

  std::vector<WorkDone> work() const override {
    return {{"node, node", nodes_done() - nodes_before_},
            {"sphere, sixteen spheres", tests_done() - tests_before_}};
  }

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(BoundsVisitor& visitor) const override {
    if (built()) SphereNodes(tree_, spheres_).show(visitor);
  }

 private:
  void construct(const ChainView& chain) override {
    spheres_ = chain.size;
    build_sphere_tree(chain, tree_, {}, team_);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    nodes_before_ = nodes_done(), tests_before_ = tests_done();
    search_sphere_tree(chain, tree_, queues_, collector, team_);
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    const SphereNodes nodes(tree_, spheres_);
    search_sphere_tree(chain, tree_, queues_[0], lane, SphereEvidence(chain, nodes, sink));
  }
  const Team& team() const override { return team_; }

  std::uint64_t nodes_done() const {
    std::uint64_t nodes = 0;
    for (const SphereQueues& queues : queues_) nodes += queues.nodes_done;
    return nodes;
  }
  std::uint64_t tests_done() const {
    std::uint64_t tests = 0;
    for (const SphereQueues& queues : queues_) tests += queues.tests_done;
    return tests;
  }

  const Team team_;
  std::uint32_t spheres_ = 0;  // of the last build
  SphereTree tree_;
  std::vector<SphereQueues> queues_;                   // [member of the team]
  std::uint64_t nodes_before_ = 0, tests_before_ = 0;  // the last search
};

const RegisterVariant<SpheresInSpace, Robust> registered{
    {.name = "SphereTree",
     .summary = "single spheres in the order of space, sixteen a node, SIMD",
     .parameters = {Team::threads_parameter()}}};

}  // namespace
}  // namespace catena
