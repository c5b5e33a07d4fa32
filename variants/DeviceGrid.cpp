#include "catena/core/arithmetic/in_range.h"
#include "catena/core/cells/host_sphere_cells.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// DeviceGrid with its steps run on the host, one after the other.
template <class Arithmetic>
class DeviceGridOnHost final : public Variant {
 public:
  void build(const Chain& chain) override {
    const Stopwatch watch;
    built_ = false;
    cells_.build(chain.view(), chain.size(), [](std::uint32_t) { return true; });
    spheres_ = chain.size();
    built_ = true;
    timings_.build_ms = watch.ms();
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (!built_ || chain.size() != spheres_) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    const ChainView view = chain.view();
    PairCollector collector(spheres_, request, result);
    LaneSink sink{collector.lane(0)};
    with_tests_for<Arithmetic>(view, [&](auto tests) { cells_.search<decltype(tests)>(view, sink); });
    collector.finish();
    in_range_ = in_range<Arithmetic>(view);
    timings_.find_ms = watch.ms();
  }

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }
  Timings timings() const override { return timings_; }

 private:
  HostSphereCells cells_;
  std::uint32_t spheres_ = 0;
  bool built_ = false, in_range_ = false;
  Timings timings_;
};

const RegisterVariant<DeviceGridOnHost, Robust> registered{
    {.name = "DeviceGrid@host", .summary = "spheres in hashed cells, an octave of radii a level"}};

}  // namespace
}  // namespace catena
