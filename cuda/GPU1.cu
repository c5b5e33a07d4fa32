#include "catena/core/policies/GPU1.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_result.h"
#include "catena/cuda/device_visitor.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {
namespace {

template <class Arithmetic>
__global__ void search(const __grid_constant__ ChainView chain, const __grid_constant__ ResultView result) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= chain.size) return;
  DeviceVisitor visitor(i, result);
  if (visitor.satisfied()) return;
  policy::GPU1<Arithmetic>::visit(i, chain, visitor);
  if (result.count != nullptr) result.count[i] = visitor.collisions;
  visitor.finish();
}

/// GPU1 (Section 3) on the device: one thread per sphere against all others, no hierarchy.
template <class Arithmetic>
class GPU1 final : public Variant {
 public:
  explicit GPU1(const Parameters& parameters)
      : threads_(parameters.unsigned_integer("threads", 32, 1024)),
        mover_(StrategyRegistry::instance().make_mover()) {}

  void build(const Chain& chain) override {
    const Stopwatch watch;
    chain_ = mover_->to_device(chain.view());
    upload_ms_ = watch.ms();
  }

  void find(const Chain&, const Request& request, Collisions& result) override {
    result_.run(chain_.size, request, result, stream_, [this](const ResultView& view) {
      launch(search<Arithmetic>, chain_.size, threads_, stream_, chain_, view);
    });
  }

  Timings timings() const override { return {0, result_.find_ms(), upload_ms_ + result_.transfer_ms()}; }

 private:
  unsigned threads_;
  std::unique_ptr<Mover> mover_;
  Stream stream_;
  DeviceResult result_;
  ChainView chain_{};
  double upload_ms_ = 0;
};

const RegisterVariant<GPU1, Robust, Literal, Double> registered{
    {.name = "GPU1",
     .summary = "all pairs, one thread per sphere",
     .space = Space::device,
     .parameters = {{"threads", "256", "threads of a block"}},
     .all_pairs = true,
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
