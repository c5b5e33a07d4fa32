#include "catena/core/grid/grid_kernels.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// Grid: spheres in cells as wide as two of them, a level of cells for each octave of the radii; each against
/// half of its neighbourhood, a vector of candidates a test.
template <class Arithmetic>
class Grid final : public Variant {
 public:
  explicit Grid(const Parameters& parameters) : team_(parameters), queues_(team_.size()) {}

  void build(const Chain& chain) override {
    const Stopwatch watch;
    built_ = false;
    build_grid(chain.view(), grid_, {}, team_);
    spheres_ = chain.size();
    built_ = true;
    timings_.build_ms = watch.ms();
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (!built_ || chain.size() != spheres_) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    PairCollector collector(spheres_, request, result, team_.size());
    search_grid(chain.view(), grid_, queues_, collector, team_);
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  Timings timings() const override { return timings_; }

 private:
  const Team team_;
  SphereGrid grid_;
  std::vector<GridQueues> queues_;  // [member of the team]
  std::uint32_t spheres_ = 0;
  bool built_ = false;
  Timings timings_;
};

const RegisterVariant<Grid, Robust> registered{
    {.name = "Grid",
     .summary = "cells as wide as two spheres, half the neighbourhood each, SIMD",
     .parameters = {Team::threads_parameter()}}};

}  // namespace
}  // namespace catena
