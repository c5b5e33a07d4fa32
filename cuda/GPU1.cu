#include "catena/core/arithmetic/in_range.h"
#include "catena/core/policies/GPU1.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/resident_variant.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_visitor.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {
namespace {

template <class Tests>
__global__ void search(const __grid_constant__ ChainView chain, const __grid_constant__ ResidentAnswer answer,
                       SphereRange queries) {
  const std::uint32_t i = queries.begin + blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= queries.end) return;
  DeviceVisitor visitor(i, answer);
  if (visitor.satisfied()) return;
  policy::GPU1<Tests>::visit(i, chain, visitor);
  if (answer.count != nullptr) answer.count[i] = visitor.collisions;
  visitor.finish();
}

/// GPU1 (Section 3) on the device: one thread per sphere against all others, no hierarchy.
template <class Arithmetic>
class GPU1 final : public ResidentVariant {
 public:
  explicit GPU1(const Parameters& parameters)
      : ResidentVariant(StrategyRegistry::instance().make_device(device_of(parameters))),
        threads_(static_cast<unsigned>(parameters.unsigned_integer("threads", 32, 1024))) {}

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

 private:
  void enqueue_construction(const ChainView&, const Request&, StreamHandle) override {}

  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                    StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    const SphereRange queries = request.queries.within(chain.size);
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      launch(search<decltype(tests)>, queries.size(), threads_, stream, chain, answer, queries);
    });
    in_range_ = in_range<Arithmetic>(chain);
  }

  unsigned threads_;
  bool in_range_ = false;  ///< of the last search
};

const RegisterVariant<GPU1, Robust, Literal, Double> registered{
    {.name = "GPU1",
     .summary = "all pairs, one thread per sphere",
     .place = Place::device(),
     .parameters = with_device({{"threads", "256", "threads of a block"}}),
     .all_pairs = true,
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
