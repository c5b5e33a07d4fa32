#include "catena/core/arithmetic/in_range.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/resident_variant.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_sphere_cells.cuh"

namespace catena::cuda {
namespace {

/// DeviceGrid: spheres sorted into hashed cells, an octave of radii a level; a thread a sphere, against half
/// of its neighbourhood in its own level and all of it in coarser ones.
template <class Arithmetic>
class DeviceGrid final : public ResidentVariant {
 public:
  explicit DeviceGrid(const Parameters& parameters)
      : ResidentVariant(StrategyRegistry::instance().make_device(device_of(parameters))) {}

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

 private:
  void enqueue_build(const ChainView& chain, const Request&, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    SphereCells::State* const state = state_.reserve(1, stream);
    CATENA_CUDA(cudaMemsetAsync(state, 0, sizeof *state, stream));
    cells_.enqueue_build(chain, {chain.size}, state, stream);
  }

  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      StreamHandle stream) override {
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      cells_.template enqueue_search<decltype(tests)>(chain, request, answer,
                                                      static_cast<cudaStream_t>(stream));
    });
    in_range_ = in_range<Arithmetic>(chain);
  }

  DeviceBuffer<SphereCells::State> state_;
  DeviceSphereCells<AllSpheres> cells_;
  bool in_range_ = false;  ///< of the last search
};

const RegisterVariant<DeviceGrid, Robust> registered{
    {.name = "DeviceGrid",
     .summary = "spheres in hashed cells, an octave of radii a level",
     .place = Place::device(),
     .parameters = with_device({}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
