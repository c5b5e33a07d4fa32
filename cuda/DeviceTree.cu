#include <optional>
#include <type_traits>

#include "catena/core/cells/compare_in_tree.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device_blocks.cuh"
#include "catena/cuda/host_copies.cuh"
#include "catena/cuda/node_meetings.cuh"
#include "catena/cuda/pair_stage.cuh"
#include "catena/cuda/told_variant.h"

namespace catena::cuda {
namespace {

constexpr unsigned threads = 128;

/// A warp for as many blocks as one compares together.
template <class Tests, bool own_units>
__global__ void __launch_bounds__(threads)
    compare_in_tree(const __grid_constant__ ChainView chain, const __grid_constant__ BlockNodes nodes,
                    const __grid_constant__ CapsuleBlocks blocks,
                    const __grid_constant__ ResidentAnswer answer, SphereRange queries) {
  using Comparison = TreeComparison<DeviceWarp, own_units>;
  __shared__ PairStage<threads>::Shared shared;
  await_previous();
  PairStage<threads> stage(shared, answer, queries);
  __syncthreads();
  if (stage.satisfied()) return;
  const DeviceWarp warp;
  const std::uint32_t first = (blockIdx.x * blockDim.x + threadIdx.x) / DeviceWarp::lanes * Comparison::together;
  if (first < blocks.blocks) Comparison(warp, chain, nodes, blocks).template compare<Tests>(first, stage);
  stage.finish();
}

/// DeviceTree: capsules of 32 consecutive spheres in a tree of boxes in the order of the chain, from each
/// block down to those that come later.
template <class Arithmetic>
class DeviceTree final : public ToldVariant<Arithmetic> {
 public:
  explicit DeviceTree(const Parameters& parameters)
      : ToldVariant<Arithmetic>(parameters) {}

 private:
  void told(const ChainView& chain, const ToldVariant<Arithmetic>::Use& use) const override {
    std::optional<BlocksOnHost> blocks;
    std::optional<NodesOnHost> nodes;
    this->run_on_device([&](StreamHandle handle) {
      const auto stream = static_cast<cudaStream_t>(handle);
      blocks.emplace(blocks_, stream);
      nodes.emplace(of_nodes_.nodes(), stream);
    });
    use(ToldTree(chain, blocks->blocks(), nodes->nodes()));
  }

  void enqueue_construction(const ChainView& chain, const Request&, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    CapsuleBlocks::State* const state = state_.reserve(1, stream);
    blocks_ = of_blocks_.reserve(CapsuleBlocks::in_tree_alone(chain, block_scale(chain.extent)), state, stream);
    if (blocks_.blocks == 0) return;
    DeviceBlocks::enqueue_enclose(chain, blocks_, state, stream);
    of_nodes_.enqueue_fit(blocks_, BlockNodes::children, stream);
  }

  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    this->range_.template with_tests_for<Arithmetic>(chain, [&](auto tests) {
      const auto compare = [&](auto own_units) {
        constexpr std::uint32_t together =
            threads / DeviceWarp::lanes * TreeComparison<DeviceWarp, own_units.value>::together;
        launch_next<compare_in_tree<decltype(tests), own_units.value>>(
            (blocks_.blocks + together - 1) / together, threads, stream, chain, of_nodes_.nodes(), blocks_,
            answer, request.queries.within(chain.size));
      };
      blocks_.own_units ? compare(std::true_type()) : compare(std::false_type());
    });
  }

  CapsuleBlocks blocks_{};
  DeviceBlocks of_blocks_;
  DeviceBlockNodes of_nodes_;
  DeviceBuffer<CapsuleBlocks::State> state_;
};

const RegisterVariant<DeviceTree, Robust> registered{
    {.name = "DeviceTree",
     .summary = "capsules of 32 spheres in a tree of boxes along the chain",
     .place = Place::device(),
     .parameters = with_told({}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
