#pragma once
#include "catena/core/arithmetic/in_range.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/stages.h"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

/// A traversal on the device: Search<Arithmetic>::kernel, run by Search<Arithmetic>::threads_per_sphere
/// threads for each sphere that is asked about.
template <class Arithmetic, template <class> class Search>
class DeviceTraversal final : public Traversal<HierarchyView<typename Arithmetic::Bound>> {
 public:
  explicit DeviceTraversal(const Parameters& parameters)
      : threads_(static_cast<unsigned>(parameters.unsigned_integer("threads", 32, 1024))) {}

  void enqueue(const ChainView& chain, const HierarchyView<typename Arithmetic::Bound>& tree,
               const Request& request, const ResidentAnswer& answer, StreamHandle handle) override {
    const auto stream = static_cast<cudaStream_t>(handle);
    const SphereRange queries = request.queries.within(chain.size);
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      using Chosen = Search<decltype(tests)>;
      launch(Chosen::kernel, std::uint64_t{Chosen::threads_per_sphere} * queries.size(), threads_, stream,
             chain, tree, answer, queries);
    });
    in_range_ = in_range<Arithmetic>(chain);
  }

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

 private:
  unsigned threads_;
  bool in_range_ = false;  ///< of the last search
};

}  // namespace catena::cuda
