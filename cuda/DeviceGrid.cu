#include <optional>

#include "catena/core/strategy/register.h"
#include "catena/cuda/device_sphere_cells.cuh"
#include "catena/cuda/host_copies.cuh"
#include "catena/cuda/told_variant.h"

namespace catena::cuda {
namespace {

/// DeviceGrid: spheres sorted into hashed cells, an octave of radii a level; a thread a sphere, against half
/// of its neighbourhood in its own level and all of it in coarser ones.
template <class Arithmetic>
class DeviceGrid final : public ToldVariant<Arithmetic> {
 public:
  explicit DeviceGrid(const Parameters& parameters)
      : ToldVariant<Arithmetic>(parameters),
        binned_(parameters.unsigned_integer("binned", 0, 0xFFFFFFFFu)) {}

 private:
  void told(const ChainView& chain, const ToldVariant<Arithmetic>::Use& use) const override {
    std::optional<CellsOnHost> cells;
    this->run_on_device([&](StreamHandle stream) {
      cells.emplace(cells_.cells(), chain.size, static_cast<cudaStream_t>(stream));
    });
    use(ToldCells(chain, nullptr, cells->placed()));
  }

  void enqueue_construction(const ChainView& chain, const Request&, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    cells_.enqueue_build(chain, AllSpheres{chain.size}, binned_, state_.reserve(1, stream), Begin::anew,
                         stream);
  }

  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      StreamHandle stream) override {
    this->range_.template with_tests_for<Arithmetic>(chain, [&](auto tests) {
      cells_.enqueue_search<decltype(tests)>(chain, AllSpheres{chain.size}, request, answer,
                                             static_cast<cudaStream_t>(stream));
    });
  }
  bool give_back(StreamHandle stream) override { return cells_.give_back(static_cast<cudaStream_t>(stream)); }

  const std::uint64_t binned_;
  DeviceBuffer<SphereCells::State> state_;
  DeviceSphereCells cells_;
};

const RegisterVariant<DeviceGrid, Robust> registered{
    {.name = "DeviceGrid",
     .summary = "spheres in hashed cells, an octave of radii a level",
     .place = Place::device(),
     .parameters = with_told({binned_parameter()}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
