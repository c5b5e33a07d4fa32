#include <vector>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/cells/host_sphere_cells.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/resident_variant.h"
#include "catena/cuda/device.h"
#include "catena/cuda/host_copies.cuh"
#include "catena/cuda/morton_order.cuh"
#include "catena/cuda/near_queue.cuh"
#include "catena/cuda/rope_tree.cuh"

namespace catena::cuda {
namespace {

constexpr std::uint32_t threads = 128;
using Queue = NearQueue<threads>;

template <class Tests>
__global__ void __launch_bounds__(threads)
    search_tree(const __grid_constant__ ChainView chain, const __grid_constant__ RopeTree tree,
                const __grid_constant__ ResidentAnswer answer, SphereRange queries) {
  __shared__ Queue::Shared shared;
  Queue queue(shared, answer, queries);
  __syncthreads();
  const std::uint32_t leaf = blockIdx.x * blockDim.x + threadIdx.x;
  const RopeSearch<Tests, Queue> search(chain, tree, queue);
  const bool live = leaf < tree.leaves;
  if (!queue.satisfied()) search.run(live ? leaf : 0, live);
  queue.flush(search);
  queue.finish();
}

/// What a search on the host tells of the tree that the device built: inner node k is n + k to evidence.
struct TellingRopes : LaneSink {
  const ChainView& chain;
  const RopeTree& tree;
  EvidenceSink& to;
  void compared(std::uint32_t i, std::uint32_t j) const {
    chain.neighbours(i, j) ? to.excluded(i, j) : to.tested(i, j);
  }
  void apart(std::uint32_t i, std::uint32_t at) const {
    const std::uint32_t id = tree.is_leaf(at) ? tree.node[at].left : chain.size + at;
    to.compared(i, id);
    to.discarded(i, id);
  }
};

/// DeviceLBVH: what a general library does on a GPU. Boxes over the order of Morton codes, one sphere a leaf,
/// and the half traversal along ropes (ArborX).
template <class Arithmetic>
class DeviceLBVH final : public ResidentVariant, public EvidenceNodes {
 public:
  explicit DeviceLBVH(const Parameters& parameters)
      : ResidentVariant(StrategyRegistry::instance().make_device(device_of(parameters))) {}

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain&, BoundsVisitor& visitor) const override {
    with_tree_on_host([&](const RopeTree& tree) {
      visitor.tree({});
      for (std::uint32_t k = 0; k + 1 < tree.leaves; ++k) {
        const std::uint32_t left = tree.node[k].left, right = tree.node[left].rope;  // its subtree's next
        for (const std::uint32_t child : {left, right}) {
          const RopeTree::Node& node = tree.node[child];
          const bool leaf = tree.is_leaf(child);
          visitor.edge(tree.leaves + k, tree.node[k].box.shown(), leaf ? node.left : tree.leaves + child,
                       leaf ? AnyBound(Everything{}) : AnyBound(node.box.shown()));
        }
      }
    });
  }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& to) override {
    check(chain);
    const ChainView view = chain.view();
    PairCollector collector(chain.size(), request, result);
    with_tree_on_host([&](const RopeTree& tree) {
      with_tests_for<Arithmetic>(view, [&](auto tests) {
        TellingRopes sink{{collector.lane(0)}, view, tree, to};
        const RopeSearch<decltype(tests), TellingRopes> search(view, tree, sink);
        for (std::uint32_t leaf = 0; leaf < tree.leaves; ++leaf) search.run(leaf, true);
      });
    });
    collector.finish();
  }

 private:
  template <class Use>
  void with_tree_on_host(const Use& use) const {
    std::vector<RopeTree::Node> node;
    run_on_device([&](StreamHandle stream) {
      node = fetched(tree_.node, tree_.leaves == 0 ? 0 : 2 * std::size_t{tree_.leaves} - 1,
                     static_cast<cudaStream_t>(stream));
    });
    RopeTree on_host = tree_;
    on_host.node = node.data();
    use(on_host);
  }

  void enqueue_construction(const ChainView& chain, const Request&, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    const std::uint32_t n = chain.size;
    tree_ = {};
    if (n == 0) return;
    order_.enqueue(chain, stream);
    tree_ = {n, node_.reserve(2 * std::size_t{n} - 1, stream), range_.reserve(n, stream), order_.code(),
             order_.id()};
    CATENA_CUDA(cudaMemsetAsync(tree_.range, 0xFF, n * sizeof *tree_.range, stream));
    launch(build_rope_tree<ChainView>, n, 256, stream, chain, tree_);
  }

  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      StreamHandle stream) override {
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      launch(search_tree<decltype(tests)>, chain.size, 128, static_cast<cudaStream_t>(stream), chain, tree_,
             answer, request.queries.within(chain.size));
    });
    in_range_ = in_range<Arithmetic>(chain);
  }

  MortonOrder order_;
  DeviceBuffer<RopeTree::Node> node_;
  DeviceBuffer<std::uint32_t> range_;
  RopeTree tree_{};
  bool in_range_ = false;  ///< of the last search
};

const RegisterVariant<DeviceLBVH, Robust> registered{
    {.name = "DeviceLBVH",
     .summary = "boxes in order of Morton codes, half traversal along ropes: the general baseline",
     .place = Place::device(),
     .parameters = with_device({}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
