#pragma once
#include <vector>

#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/cells/host_sphere_cells.h"
#include "catena/cuda/call.h"

namespace catena::cuda {

/// So many elements of a device, once the stream has come to it. Waits.
template <class T>
std::vector<T> fetched(const T* device, std::size_t count, cudaStream_t stream) {
  std::vector<T> host(count);
  if (count == 0) return host;
  CATENA_CUDA(cudaMemcpyAsync(host.data(), device, count * sizeof(T), cudaMemcpyDeviceToHost, stream));
  CATENA_CUDA(cudaStreamSynchronize(stream));
  return host;
}
inline std::vector<std::uint32_t> fetched_starts(const Buckets& device, const CellTable& table,
                                                 cudaStream_t stream) {
  return fetched(device.start, Buckets::starts(Buckets::chunks(table)), stream);
}

/// A device's SphereCells, whose spheres have their places, in host memory; to be read.
class CellsOnHost {
 public:
  /// `expected` is what the device took the number of spheres to be.
  CellsOnHost(const SphereCells& device, std::uint32_t expected, cudaStream_t stream)
      : state_(fetched(device.state, 1, stream)), placed_{device, device.table_for(expected)} {
    SphereCells& cells = placed_.cells;
    cells.state = state_.data();
    const std::uint32_t places = cells.places();
    if (places > 0) start_ = fetched_starts(device.buckets, placed_.table, stream);
    if (!device.octaves.equal) index_ = fetched(device.index, places, stream);
    sphere_ = fetched(device.sphere, places, stream);
    sphere_.resize(places + std::size_t{SphereCells::at_once});  // which are read, behind the last place
    if (!cells.one_level()) map_ = fetched(device.map.word, device.map.words(), stream);
    cells.buckets = {nullptr, start_.data(), nullptr, nullptr}, cells.map.word = map_.data();
    cells.index = index_.data(), cells.sphere = sphere_.data();
  }
  CellsOnHost(const CellsOnHost&) = delete;
  CellsOnHost& operator=(const CellsOnHost&) = delete;

  const PlacedCells& placed() const { return placed_; }

 private:
  std::vector<SphereCells::State> state_;
  std::vector<std::uint32_t> start_, index_, map_;
  std::vector<Sphere> sphere_;
  PlacedCells placed_;
};

/// A device's CapsuleBlocks, which have met, in host memory; to be read.
class BlocksOnHost {
 public:
  BlocksOnHost(const CapsuleBlocks& device, cudaStream_t stream)
      : state_(fetched(device.state, 1, stream)), blocks_(device) {
    blocks_.state = state_.data(), blocks_.look = nullptr;
    const std::size_t n = device.blocks;
    capsule_ = fetched(device.capsule, n, stream), shape_ = fetched(device.shape, n, stream);
    partners_ = fetched(device.partners, n, stream), met_ = fetched(device.met, n, stream);
    if (device.partner != nullptr)
      partner_ = fetched(device.partner, CapsuleBlocks::most_partners * n, stream);
    blocks_.capsule = capsule_.data(), blocks_.shape = shape_.data();
    blocks_.partners = partners_.data(), blocks_.met = met_.data(), blocks_.partner = partner_.data();
    if (!device.in_cells || state_[0].places == 0) return;
    start_ = fetched_starts(device.buckets, device.table, stream);
    ball_ = fetched(device.ball, state_[0].places, stream),
    id_ = fetched(device.id, state_[0].places, stream);
    blocks_.buckets = {nullptr, start_.data(), nullptr, nullptr};
    blocks_.ball = ball_.data(), blocks_.id = id_.data();
  }
  BlocksOnHost(const BlocksOnHost&) = delete;
  BlocksOnHost& operator=(const BlocksOnHost&) = delete;

  const CapsuleBlocks& blocks() const { return blocks_; }

 private:
  std::vector<CapsuleBlocks::State> state_;
  std::vector<BlockCapsule> capsule_;
  std::vector<std::uint8_t> shape_;
  std::vector<std::uint32_t> partners_, met_, partner_, start_, id_;
  std::vector<CapsuleBall> ball_;
  CapsuleBlocks blocks_;
};

/// A device's BlockNodes, whose boxes are fitted, in host memory; to be read.
class NodesOnHost {
 public:
  NodesOnHost(const BlockNodes& device, cudaStream_t stream)
      : quarter_(fetched(device.quarter, BlockNodes::quarters * std::size_t{device.nodes()}, stream)),
        nodes_(device) {
    nodes_.quarter = quarter_.data();
  }
  NodesOnHost(const NodesOnHost&) = delete;
  NodesOnHost& operator=(const NodesOnHost&) = delete;

  const BlockNodes& nodes() const { return nodes_; }

 private:
  std::vector<BlockNodes::Quarter> quarter_;
  BlockNodes nodes_;
};

}  // namespace catena::cuda
