#include <cuda_runtime.h>

#include <cmath>
#include <vector>

#include "catena/core/executor/host_executor.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/resident_variant.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/device_visitor.cuh"
#include "catena/cuda/launch.cuh"

// A device-resident search of its own in one file: a box for every 32 consecutive spheres, each sphere
// against the boxes. Registered in the test program, so that every property meets it where there is a device.
namespace catena {
namespace example {

constexpr std::uint32_t block = 32;

struct BlockBox {
  float low[3], high[3];
};

CATENA_HD BlockBox box_around(const ChainView& chain, std::uint32_t k) {
  BlockBox box{{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};
  const std::uint32_t end = chain.size < (k + 1) * block ? chain.size : (k + 1) * block;
  for (std::uint32_t i = k * block; i < end; ++i) {
    const Sphere& s = chain.spheres[i];
    const float c[] = {s.x, s.y, s.z};
    for (int a = 0; a < 3; ++a) {  // rounded outward
      box.low[a] = fminf(box.low[a], nextafterf(c[a] - s.radius, -HUGE_VALF));
      box.high[a] = fmaxf(box.high[a], nextafterf(c[a] + s.radius, HUGE_VALF));
    }
  }
  return box;
}

/// All that the thread of sphere i does, on the device and on the host, whose visitors run on the host alone.
#pragma nv_exec_check_disable
template <class Arithmetic, class V>
CATENA_HD void search_sphere(std::uint32_t i, const ChainView& chain, const BlockBox* boxes, V& visitor) {
  const Sphere s = chain.spheres[i];
  const float c[] = {s.x, s.y, s.z};
  const std::uint32_t blocks = (chain.size + block - 1) / block;
  for (std::uint32_t k = 0; k < blocks; ++k) {
    bool apart = false;
    for (int a = 0; a < 3; ++a)
      apart |= nextafterf(c[a] + s.radius, HUGE_VALF) < boxes[k].low[a] ||
               boxes[k].high[a] < nextafterf(c[a] - s.radius, -HUGE_VALF);
    if (apart) {
      visitor.discarded(chain.size + k);
      continue;
    }
    const std::uint32_t end = chain.size < (k + 1) * block ? chain.size : (k + 1) * block;
    for (std::uint32_t j = k * block; j < end; ++j) {
      if (j == i) continue;
      if (chain.neighbours(i, j)) {
        visitor.excluded(j);
        continue;
      }
      visitor.tested_pair(j);
      if (Arithmetic::overlap(s, chain.spheres[j])) visitor.hit(j);
    }
  }
}

__global__ void make_boxes(const __grid_constant__ ChainView chain, BlockBox* boxes, std::uint32_t blocks) {
  const std::uint32_t k = blockIdx.x * blockDim.x + threadIdx.x;
  if (k < blocks) boxes[k] = box_around(chain, k);
}

template <class Arithmetic>
__global__ void search_boxes(const __grid_constant__ ChainView chain, const BlockBox* boxes,
                             const __grid_constant__ ResidentAnswer answer, SphereRange queries) {
  const std::uint32_t i = queries.begin + blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= queries.end) return;
  cuda::DeviceVisitor visitor(i, answer);
  search_sphere<Arithmetic>(i, chain, boxes, visitor);
  if (answer.count != nullptr) answer.count[i] = visitor.collisions;
  visitor.finish();
}

template <class Arithmetic>
class ResidentBlocks final : public ResidentVariant {
 public:
  ResidentBlocks() : ResidentVariant(StrategyRegistry::instance().make_device()) {}

  void visit_bounds(BoundsVisitor& visitor) const override {
    const std::vector<BlockBox> boxes = downloaded();
    const std::uint32_t blocks = blocks_of(spheres_);
    visitor.tree(TreeFacts{blocks > 0 ? 3u : 0u, false});
    for (std::uint32_t k = 0; k < blocks; ++k) {
      const BlockBox& b = boxes[k];
      const Box64 shown{{b.low[0], b.low[1], b.low[2]}, {b.high[0], b.high[1], b.high[2]}};
      visitor.edge(spheres_ + blocks, Everything{}, spheres_ + k, shown);
      for (std::uint32_t i = k * block; i < spheres_ && i < (k + 1) * block; ++i)
        visitor.edge(spheres_ + k, shown, i, Everything{});
    }
  }

  /// The policy of the kernel on the boxes that the device made.
  Accounting evidence() const override { return Accounting::from_both_ends; }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    const std::vector<BlockBox> boxes = downloaded();
    const ChainView view = chain.view();
    const HostExecutor executor(Parameters("ResidentBlocks", {HostExecutor::threads_parameter()}, ""));
    executor.for_each_sphere(view.size, request, result, sink, [&](std::uint32_t i, auto& visitor) {
      search_sphere<Arithmetic>(i, view, boxes.data(), visitor);
    });
  }

 private:
  static std::uint32_t blocks_of(std::uint32_t n) { return (n + block - 1) / block; }

  void enqueue_construction(const ChainView& chain, const Request&, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    spheres_ = chain.size;
    const std::uint32_t blocks = blocks_of(chain.size);
    BlockBox* boxes = boxes_.reserve(blocks, stream);
    cuda::launch(make_boxes, blocks, 128, stream, chain, boxes, blocks);
  }
  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                    StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    const SphereRange queries = request.queries.within(chain.size);
    const BlockBox* boxes = boxes_.data();
    cuda::launch(search_boxes<Arithmetic>, queries.size(), 128, stream, chain, boxes, answer, queries);
  }

  std::vector<BlockBox> downloaded() const {
    std::vector<BlockBox> boxes(blocks_of(spheres_));
    CATENA_CUDA(
        cudaMemcpy(boxes.data(), boxes_.data(), boxes.size() * sizeof(BlockBox), cudaMemcpyDeviceToHost));
    return boxes;
  }

  cuda::DeviceBuffer<BlockBox> boxes_;
  std::uint32_t spheres_ = 0;
};

const RegisterVariant<ResidentBlocks, Robust> resident_blocks{{.name = "ResidentBlocks",
                                                               .summary = "boxes of 32, resident",
                                                               .place = Place::device(),
                                                               .has_tree = true,
                                                               .promises = {.same_bits = true},
                                                               .unavailable = cuda::unavailable}};

}  // namespace example
}  // namespace catena
