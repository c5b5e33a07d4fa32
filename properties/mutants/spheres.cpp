#include <algorithm>
#include <limits>

#include "catena/core/executor/host_search.h"
#include "catena/core/sphere_tree/sphere_kernels.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/properties/mutants/mutant.h"

// Bugs of a search by single spheres in the order of space.
namespace catena::properties {
namespace {

/// SphereTree, tampered with after it was built.
class FaultySpheres : public HostSearch, public EvidenceNodes {
 public:
  using Base = FaultySpheres;

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain&, BoundsVisitor& visitor) const override {
    if (built()) SphereNodes(tree_, spheres_).show(visitor);
  }

 protected:
  static constexpr std::uint32_t group = SphereTree::group;

  virtual void tamper(SphereTree&) {}
  /// After an update, which may have kept an order.
  virtual void tamper_updated(SphereTree& tree, const BoxLevels& boxes_before) {
    static_cast<void>(boxes_before);
    tamper(tree);
  }

 private:
  void construct(const ChainView& chain) override {
    spheres_ = chain.size;
    build_sphere_tree(chain, tree_, {}, team());
    if (tree_.spheres > 0) tamper(tree_);
  }
  void construct_again(const ChainView& chain) override {
    boxes_before_ = tree_.boxes;
    build_sphere_tree(chain, tree_, {}, team(), SpaceSort::where_needed);
    if (tree_.spheres > 0) tamper_updated(tree_, boxes_before_);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    search_sphere_tree(chain, tree_, {&queues_, 1}, collector, team());
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    const SphereNodes nodes(tree_, spheres_);
    search_sphere_tree(chain, tree_, queues_, lane, SphereEvidence(chain, nodes, sink));
  }

  std::uint32_t spheres_ = 0;
  SphereTree tree_;
  BoxLevels boxes_before_;
  SphereQueues queues_;
};

class BoxesOfCentres final : public FaultySpheres {
  void tamper(SphereTree& tree) override {
    for (std::uint32_t k = 0; k < tree.nodes(); ++k) {
      float* const box = tree.boxes_of(0, k / group) + k % group;
      for (std::uint32_t d = 0; d < 3; ++d) {
        float &low = box[d * group], &high = box[(3 + d) * group];
        const float eighth = (high - low) / 8;
        low += eighth, high -= eighth;
      }
    }
  }
};
const RegisterMutant<BoxesOfCentres> boxes_of_centres{"sphere-tree-box-too-small",
                                                      "boxes of nodes that leave the thickness out"};

class LastNodeLost final : public FaultySpheres {
  void tamper(SphereTree& tree) override {
    const std::uint32_t k = tree.nodes() - 1;
    float* const box = tree.boxes_of(0, k / group) + k % group;
    for (std::uint32_t d = 0; d < 3; ++d) box[d * group] = std::numeric_limits<float>::infinity();
  }
};
const RegisterMutant<LastNodeLost> last_node{
    "sphere-tree-drops-its-last-node", "sixteen boxes at a time, and the last that are there forgotten"};

/// What fills a node up begins one too early.
class LastSphereLost final : public FaultySpheres {
  void tamper(SphereTree& tree) override {
    const std::uint32_t last = tree.spheres - 1;
    tree.fields_of(last / group)[last % group] = std::numeric_limits<float>::quiet_NaN();
  }
};
const RegisterMutant<LastSphereLost> last_sphere{"sphere-tree-drops-its-last-sphere",
                                                 "sixteen spheres at a time, and the last one filled up"};

/// Copies in place of what fills a node up.
class CopiesMeet final : public FaultySpheres {
  void tamper(SphereTree& tree) override {
    const std::uint32_t last = tree.spheres - 1;
    float* const fields = tree.fields_of(last / group);
    for (std::uint32_t k = last % group + 1; k < group; ++k) fields[k] = fields[last % group];
  }
};
const RegisterMutant<CopiesMeet> copies{
    "sphere-tree-meets-its-filling",
    "a last node filled up with copies, which overlap what the last sphere does"};

/// Sixteen nodes go down the tree together, in the box of the first of them.
class SixteenInOneBox final : public FaultySpheres {
  void tamper(SphereTree& tree) override {
    if (tree.boxes.size() == 1) return;
    for (std::uint32_t k = 0; k < tree.count(1); ++k) {
      float* const box = tree.boxes_of(1, k / group) + k % group;
      for (std::uint32_t f = 0; f < SphereTree::box_fields; ++f)
        box[f * group] = tree.boxes_of(0, k)[f * group];
    }
  }
};
const RegisterMutant<SixteenInOneBox> one_box{
    "sphere-tree-goes-down-with-the-first",
    "nodes that go down the tree together, of which the first alone is asked"};

/// An order is kept, and with it the boxes.
class BoxesOfTheLastFrame final : public FaultySpheres {
  void tamper_updated(SphereTree& tree, const BoxLevels& boxes_before) override { tree.boxes = boxes_before; }
};
const RegisterMutant<BoxesOfTheLastFrame> old_boxes{
    "sphere-tree-keeps-its-boxes",
    "an order that is kept from frame to frame, and with it the boxes around what moved"};

/// An order is kept, of which the first sphere stands where the second does.
class OrderWithoutOne final : public FaultySpheres {
  void tamper_updated(SphereTree& tree, const BoxLevels&) override {
    if (tree.spheres < 2) return;
    tree.index[1] = tree.index[0];
    for (std::uint32_t f = 0; f < SphereTree::sphere_fields; ++f)
      tree.fields_of(0)[f * group + 1] = tree.fields_of(0)[f * group];
  }
};
const RegisterMutant<OrderWithoutOne> without_one{
    "sphere-tree-keeps-an-order-without-one",
    "an order kept from frame to frame that is not one of all spheres"};

}  // namespace
}  // namespace catena::properties
