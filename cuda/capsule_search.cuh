#pragma once
#include <algorithm>
#include <optional>
#include <type_traits>

#include "catena/core/cells/compare_blocks.h"
#include "catena/cuda/capsule_cells.cuh"
#include "catena/cuda/device_blocks.cuh"
#include "catena/cuda/device_sphere_cells.cuh"
#include "catena/cuda/host_copies.cuh"
#include "catena/cuda/pair_stage.cuh"
#include "catena/cuda/told_variant.h"

namespace catena::cuda {

constexpr unsigned comparing_threads = 128;

/// The warps of a thread block share the work of `together` blocks: most have none, and some have much. More
/// warps at a time, with some registers spilt, are quicker than fewer.
template <class Tests, bool own_units>
__global__ void __launch_bounds__(comparing_threads, 8)
    compare_blocks(const __grid_constant__ ChainView chain, const __grid_constant__ CapsuleBlocks blocks,
                   const __grid_constant__ ResidentAnswer answer, SphereRange queries,
                   std::uint32_t together) {
  using Comparison = BlockComparison<DeviceWarp, own_units>;
  using Work = Comparison::Work;
  constexpr std::uint32_t kinds = static_cast<std::uint32_t>(Work::kinds);
  constexpr unsigned threads = comparing_threads, warps = threads / 32;
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

/// At first 0.
struct CapsuleSearchState {
  CapsuleBlocks::State blocks;
  SphereCells::State cells;
};

/// Capsules of 32 consecutive spheres, tangled ones in hashed cells, and blocks that meet too many others
/// searched among one another as in DeviceGrid. Who derives says how blocks are laid out and what is tangled.
template <class Arithmetic>
class CapsuleSearch : public ToldVariant<Arithmetic> {
 protected:
  explicit CapsuleSearch(const Parameters& parameters)
      : ToldVariant<Arithmetic>(parameters),
        crowd_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("crowd", 0, CapsuleBlocks::most_partners))),
        binned_(parameters.unsigned_integer("binned", 0, 0xFFFFFFFFu)) {}

  /// How blocks of a chain are laid out, at `scale`; a block that meets more than `crowd` others is crowded.
  virtual CapsuleBlocks laid_out(const ChainView& chain, std::uint32_t crowd, float scale) const = 0;
  /// Enqueues kernels that tell of every block whom it meets, or that it is tangled (BlockMeeting::tell).
  virtual void enqueue_telling(const CapsuleBlocks& blocks, cudaStream_t stream) = 0;

 private:
  void told(const ChainView& chain, const ToldVariant<Arithmetic>::Use& use) const override {
    std::optional<BlocksOnHost> blocks;
    std::optional<CellsOnHost> cells;
    this->run_on_device([&](StreamHandle handle) {
      const auto stream = static_cast<cudaStream_t>(handle);
      if (!blocks_.all_crowded) blocks.emplace(blocks_, stream);
      cells.emplace(cells_.cells(), blocks ? blocks->blocks().crowded_spheres() : chain.size, stream);
    });
    use(ToldCells(chain, blocks ? &blocks->blocks() : nullptr, cells->placed()));
  }

  void enqueue_construction(const ChainView& chain, const Request&, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    blocks_ = laid_out(chain, crowd_, block_scale(chain.extent));
    CapsuleSearchState* const state = state_.reserve(1, stream);
    if (!blocks_.all_crowded) {
      blocks_ = of_blocks_.reserve(blocks_, &state->blocks, stream);
      of_blocks_.reserve_cells(blocks_, stream);
    }
    if (blocks_.blocks == 0) return;
    if (blocks_.all_crowded)
      return cells_.enqueue_build(chain, AllSpheres{chain.size}, binned_, &state->cells, Begin::anew, stream);
    DeviceBlocks::enqueue_enclose(chain, blocks_, state, stream);
    enqueue_telling(blocks_, stream);
    if (blocks_.in_cells) enqueue_capsule_cells(blocks_, stream);
    cells_.enqueue_build(chain, CrowdedSpheres{blocks_, chain.size}, binned_, &state->cells, Begin::cleared,
                         stream);
  }

  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    this->range_.template with_tests_for<Arithmetic>(chain, [&](auto tests) {
      using Tests = decltype(tests);
      if (blocks_.all_crowded)
        return cells_.enqueue_search<Tests>(chain, AllSpheres{chain.size}, request, answer, stream);
      constexpr std::uint32_t for_whole_device = 1056;  // thread blocks
      std::uint32_t together = comparing_threads;       // as far as there are so many
      while (together > 8 && blocks_.blocks / together < for_whole_device) together /= 2;
      const auto compare = [&](auto own_units) {
        launch_next<compare_blocks<Tests, own_units.value>>(
            (blocks_.blocks + together - 1) / together, comparing_threads, stream, chain, blocks_, answer,
            request.queries.within(chain.size), together);
      };
      blocks_.own_units ? compare(std::true_type()) : compare(std::false_type());
      cells_.enqueue_search<Tests>(chain, CrowdedSpheres{blocks_, chain.size}, request, answer, stream);
    });
  }
  bool give_back(StreamHandle stream) override { return cells_.give_back(static_cast<cudaStream_t>(stream)); }

  const std::uint32_t crowd_;
  const std::uint64_t binned_;
  CapsuleBlocks blocks_{};
  DeviceBlocks of_blocks_;
  DeviceBuffer<CapsuleSearchState> state_;
  DeviceSphereCells cells_;
};

/// The parameters of such a search, which has these of its own.
inline std::vector<ParameterInfo> with_capsules(std::vector<ParameterInfo> own) {
  own.insert(own.begin(), {"crowd", "8", "a block that meets more others is left to the grid"});
  own.push_back(binned_parameter());
  return with_told(std::move(own));
}

}  // namespace catena::cuda
