#include <algorithm>
#include <optional>
#include <type_traits>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/compare_blocks.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/core/cells/told_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/resident_variant.h"
#include "catena/cuda/block_meetings.cuh"
#include "catena/cuda/clear_by_block.cuh"
#include "catena/cuda/device.h"
#include "catena/cuda/device_buckets.cuh"
#include "catena/cuda/device_sphere_cells.cuh"
#include "catena/cuda/device_warp.cuh"
#include "catena/cuda/host_copies.cuh"
#include "catena/cuda/node_meetings.cuh"
#include "catena/cuda/pair_stage.cuh"

namespace catena::cuda {
namespace {

constexpr unsigned threads = 128, warps = threads / 32;

/// Spheres that a warp shares, from the first on; one place in nine is left free, so that threads which read
/// eight apart find them in different banks.
struct WarpSpheres {
  static constexpr std::uint32_t blocks = DeviceWarp::lanes / DeviceQuad::lanes, count = 32 * (blocks + 1);
  Sphere sphere[count + count / 8];
  __device__ static std::uint32_t slot(std::uint32_t k) { return k + k / 8; }
};

/// At first 0.
struct State {
  CapsuleBlocks::State blocks;
  SphereCells::State cells;
};

/// Four threads a block of spheres; the first kernel, which clears the state too.
__global__ void __launch_bounds__(threads)
    enclose_blocks(const __grid_constant__ ChainView chain, const __grid_constant__ CapsuleBlocks blocks,
                   State* state) {
  if (blockIdx.x == 0) clear_by_block(state);
  __shared__ WarpSpheres shared[warps];
  WarpSpheres& own = shared[threadIdx.x / 32];
  const std::uint32_t first = (blockIdx.x * warps + threadIdx.x / 32) * WarpSpheres::blocks;
  constexpr std::uint32_t share = WarpSpheres::count / DeviceWarp::lanes;
  Sphere mine[share];  // all on their way before the first is waited for
#pragma unroll
  for (std::uint32_t k = 0; k < share; ++k)
    mine[k] = chain.spheres[min(first * CapsuleBlocks::block + k * DeviceWarp::lanes + DeviceWarp::lane(),
                                chain.size - 1)];
#pragma unroll
  for (std::uint32_t k = 0; k < share; ++k)
    own.sphere[WarpSpheres::slot(k * DeviceWarp::lanes + DeviceWarp::lane())] = blocks.scaled(mine[k]);
  __syncwarp();
  const std::uint32_t of_warp = DeviceWarp::lane() / DeviceQuad::lanes;
  const Sphere* const begin = own.sphere + WarpSpheres::slot(of_warp * CapsuleBlocks::block);
  const auto at = [begin](std::uint32_t k) { return begin[WarpSpheres::slot(k)]; };
  BlockMeeting(blocks).enclose(DeviceQuad(), at, first + of_warp);
}

struct BlockChunks {
  CapsuleBlocks blocks;
  __device__ std::uint32_t operator()() const {
    return blocks.any_in_cells() ? Buckets::chunks(blocks.table) : 0;
  }
  __device__ float* square_sum() const { return nullptr; }
  __device__ std::uint32_t* in_crowds() const { return nullptr; }
};

__global__ void __launch_bounds__(256) enter_blocks(const __grid_constant__ CapsuleBlocks blocks) {
  await_previous();
  if (!blocks.any_in_cells()) return;
  const BlockMeeting meeting(blocks);
  for_each_of_mine(blocks.blocks, [&](std::uint32_t b) { meeting.enter(b); });
}

__global__ void __launch_bounds__(256) place_blocks(const __grid_constant__ CapsuleBlocks blocks) {
  await_previous();
  if (!blocks.any_in_cells()) return;
  const BlockMeeting meeting(blocks);
  for_each_of_mine(blocks.blocks, [&](std::uint32_t b) { meeting.place(b); });
}

__global__ void __launch_bounds__(BlockMeetings::threads)
    meet_blocks(const __grid_constant__ CapsuleBlocks blocks) {
  __shared__ BlockMeetings::Shared shared;
  await_previous();
  if (blocks.state->levels == 0) return;
  for (std::uint32_t first = blockIdx.x * BlockMeetings::together; first < blocks.blocks;
       first += gridDim.x * BlockMeetings::together)
    BlockMeetings(blocks, shared, first).meet();  // ends with a barrier, as there is a level
}

/// The warps of a thread block share the work of `together` blocks: most have none, and some have much. More
/// warps at a time, with some registers spilt, are quicker than fewer.
template <class Tests, bool own_units>
__global__ void __launch_bounds__(threads, 8)
    compare_blocks(const __grid_constant__ ChainView chain, const __grid_constant__ CapsuleBlocks blocks,
                   const __grid_constant__ ResidentAnswer answer, SphereRange queries,
                   std::uint32_t together) {
  using Comparison = BlockComparison<DeviceWarp, own_units>;
  using Work = Comparison::Work;
  constexpr std::uint32_t kinds = static_cast<std::uint32_t>(Work::kinds);
  __shared__ struct { std::uint8_t block, work; } item[threads * kinds];
  __shared__ std::uint32_t items;
  __shared__ PairStage<threads>::Shared shared;
  await_previous();
  if (blocks.all_left()) return;
  const DeviceWarp warp;
  const Comparison comparison(warp, chain, blocks);
  const std::uint32_t first = blockIdx.x * together, b = first + threadIdx.x;
  if (threadIdx.x == 0) items = 0;
  PairStage<threads> stage(shared, answer, queries);
  __syncthreads();
  if (threadIdx.x < together && b < blocks.blocks)
    comparison.plan(b, [&](Work work) {
      item[atomicAdd(&items, 1u)] = {static_cast<std::uint8_t>(threadIdx.x), static_cast<std::uint8_t>(work)};
    });
  __syncthreads();
  if (items == 0 || stage.satisfied()) return;
  for (std::uint32_t k = threadIdx.x / 32; k < items; k += warps)
    comparison.template compare<Tests>(first + item[k].block, static_cast<Work>(item[k].work), stage);
  stage.finish();
}

/// The spheres of crowded blocks, for the grid of spheres; block by block as these lie in space, so that what
/// is written together lies together.
struct CrowdedSpheres {
  static constexpr std::uint32_t threads = 512, most_blocks = 528, most_search_blocks = 1056;
  CapsuleBlocks blocks;
  std::uint32_t size;
  __device__ bool all() const { return blocks.all_left(); }
  __device__ bool any() const { return all() || blocks.state->any != 0; }
  __device__ bool in_space() const { return blocks.in_cells && !blocks.all_left(); }
  __device__ std::uint32_t asked() const {
    return (in_space() ? blocks.state->places : blocks.blocks) * CapsuleBlocks::block;
  }
  __device__ std::uint32_t block(std::uint32_t k) const {
    const std::uint32_t at = k / CapsuleBlocks::block;
    return in_space() ? blocks.id[at] >> 5 : at;
  }
  __device__ std::uint32_t sphere(std::uint32_t k) const {
    return block(k) * CapsuleBlocks::block + k % CapsuleBlocks::block;
  }
  __device__ bool takes(std::uint32_t k) const { return (sphere(k) < size) & blocks.crowded(block(k)); }
  __device__ std::uint32_t expected() const { return blocks.crowded_spheres(); }
};

/// DeviceHybrid: capsules of 32 consecutive spheres in a tree of boxes in the order of the chain; in hashed
/// cells where that says little of what is near; and blocks that meet too many others are searched among one
/// another as in DeviceGrid. Decided on the device, for each.
template <class Arithmetic>
class DeviceHybrid final : public ResidentVariant, public EvidenceNodes {
 public:
  explicit DeviceHybrid(const Parameters& parameters)
      : ResidentVariant(StrategyRegistry::instance().make_device(device_of(parameters))),
        crowd_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("crowd", 0, CapsuleBlocks::most_partners))),
        least_(parameters.unsigned_integer("least", 0, 0xFFFFFFFFu)),
        least_in_cells_(parameters.unsigned_integer("cells", 0, 0xFFFFFFFFu)),
        surveyed_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("survey", 0, CapsuleBlocks::most_surveyed))),
        binned_(parameters.unsigned_integer("binned", 0, 0xFFFFFFFFu)) {}

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) told(chain.view(), [&](const ToldSearch& search) { search.show(visitor); });
  }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    check(chain);
    PairCollector collector(chain.size(), request, result);
    told(chain.view(), [&](const ToldSearch& search) { search.search(collector.lane(0), sink); });
    collector.finish();
  }

 private:
  /// The blocks and cells that the device built, on the host.
  template <class Use>
  void told(const ChainView& chain, const Use& use) const {
    if (chain.size == 0) return;
    std::optional<BlocksOnHost> blocks;
    std::optional<CellsOnHost> cells;
    run_on_device([&](StreamHandle handle) {
      const auto stream = static_cast<cudaStream_t>(handle);
      if (!blocks_.all_crowded) blocks.emplace(blocks_, stream);
      cells.emplace(cells_.cells(), blocks ? blocks->blocks().crowded_spheres() : chain.size, stream);
    });
    use(ToldSearch(chain, blocks ? &blocks->blocks() : nullptr, cells->placed()));
  }

  void enqueue_construction(const ChainView& chain, const Request&, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    lay_out(chain, stream);
    const std::uint32_t n = blocks_.blocks;
    if (n == 0) return;
    State* const state = state_.data();
    if (blocks_.all_crowded)
      return cells_.enqueue_build(chain, AllSpheres{chain.size}, binned_, &state->cells, Begin::anew, stream);
    launch_blocks(enclose_blocks, up(n, warps * WarpSpheres::blocks), threads, stream, chain, blocks_, state);
    nodes_.enqueue(blocks_, stream);
    if (blocks_.in_cells) {
      launch_next<enter_blocks>(std::min(up(n, 256), most_blocks), 256, stream, blocks_);
      launch_next<allocate_buckets<BlockChunks>>(allocate_blocks(Buckets::chunks(blocks_.table)),
                                                 allocate_threads, stream, blocks_.buckets, BlockChunks{blocks_});
      launch_next<place_blocks>(std::min(up(n, 256), most_blocks), 256, stream, blocks_);
      launch_next<meet_blocks>(std::min(up(n, BlockMeetings::together), most_blocks), BlockMeetings::threads,
                               stream, blocks_);
    }
    cells_.enqueue_build(chain, CrowdedSpheres{blocks_, chain.size}, binned_, &state->cells, Begin::cleared,
                         stream);
  }

  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      using Tests = decltype(tests);
      if (blocks_.all_crowded)
        return cells_.enqueue_search<Tests>(chain, AllSpheres{chain.size}, request, answer, stream);
      std::uint32_t together = threads;  // as far as there are thread blocks for the whole device
      while (together > 8 && blocks_.blocks / together < most_blocks) together /= 2;
      const auto compare = [&](auto own_units) {
        launch_next<compare_blocks<Tests, own_units.value>>(
            up(blocks_.blocks, together), threads, stream, chain, blocks_, answer,
            request.queries.within(chain.size), together);
      };
      blocks_.own_units ? compare(std::true_type()) : compare(std::false_type());
      cells_.enqueue_search<Tests>(chain, CrowdedSpheres{blocks_, chain.size}, request, answer, stream);
    });
    in_range_ = in_range<Arithmetic>(chain);
  }
  bool give_back(StreamHandle stream) override { return cells_.give_back(static_cast<cudaStream_t>(stream)); }

  static unsigned up(std::uint32_t items, std::uint32_t together) {
    return (items + together - 1) / together;
  }

  void lay_out(const ChainView& chain, cudaStream_t stream) {
    blocks_ = CapsuleBlocks::of(chain, crowd_, block_scale(chain.extent), least_, least_in_cells_, surveyed_);
    State* const state = state_.reserve(1, stream);
    if (blocks_.all_crowded) return;
    const std::size_t n = blocks_.blocks;
    blocks_.capsule = capsule_.reserve(n, stream);
    blocks_.ball = ball_.reserve(n, stream);
    blocks_.shape = shape_.reserve(n, stream);
    blocks_.id = id_.reserve(n, stream);
    blocks_.partners = partners_.reserve(n, stream);
    const std::size_t room = CapsuleBlocks::most_partners * n;
    if (room > partner_.capacity())  // so that lists which are not full are copied whole
      CATENA_CUDA(cudaMemsetAsync(partner_.reserve(room, stream), 0, room * sizeof(std::uint32_t), stream));
    blocks_.partner = partner_.data();
    blocks_.met = met_.reserve(n, stream);
    blocks_.state = &state->blocks;
    blocks_.buckets = buckets_.reserve(blocks_.table, n, &state->blocks.places, stream);
  }

  static constexpr std::uint32_t most_blocks = 1056;  ///< of a kernel that loops over its share

  const std::uint32_t crowd_;
  const std::uint64_t least_, least_in_cells_;
  const std::uint32_t surveyed_;
  const std::uint64_t binned_;
  CapsuleBlocks blocks_{};
  DeviceBlockNodes nodes_;
  DeviceBuffer<State> state_;
  DeviceBuffer<BlockCapsule> capsule_;
  DeviceBuffer<CapsuleBall> ball_;
  DeviceBuffer<std::uint8_t> shape_;
  DeviceBuffer<std::uint32_t> id_, partners_, partner_, met_;
  DeviceBuckets buckets_;
  DeviceSphereCells cells_;
  bool in_range_ = false;  ///< of the last search
};

const RegisterVariant<DeviceHybrid, Robust> registered{
    {.name = "DeviceHybrid",
     .summary = "capsules of 32 spheres in a tree along the chain, in hashed cells where it is tangled, "
                "DeviceGrid where crowded",
     .place = Place::device(),
     .parameters = with_device(
         {{"crowd", "8", "a block that meets more others is left to the grid"},
          {"least", "300000", "chains of fewer spheres are left to the grid"},
          {"cells", "4194304", "tangled blocks of chains of fewer spheres are left to the grid"},
          {"survey", "64", "blocks asked first whom they meet: the grid gets all where it takes less; 0: none"},
          binned_parameter()}),
     .cost = Cost{.fixed_us = 140, .sphere_ns = 4.7, .start_ms = 300},
     .unavailable = unavailable,
     .started = started}};

}  // namespace
}  // namespace catena::cuda
