#include <string>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/cuda/clear_answer.cuh"
#include "catena/cuda/device.h"
#include "catena/cuda/device_answer.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/staging.h"
#include "catena/cuda/stream.h"

namespace catena::cuda {
namespace {

/// Chains, trees, work and answers of one CUDA device. What a chain does not need (strands of one open
/// strand, arc lengths under an index window, extra pairs) is not moved, and what its frames share is moved
/// once.
class CudaDevice final : public Device {
 public:
  /// To be made within a DeviceScope of that place: its stream and events belong to the device that is
  /// current.
  explicit CudaDevice(Place place) : place_(place) {}

  ChainView to_device(const ChainView& host, const Moved& moved) override {
    const DeviceScope scope(place_);
    const bool known = host.topology != 0 && host.topology == topology_.topology;
    if (!known) upload_topology(host);
    ChainView view = topology_;
    view.spheres = known && !moved.everything() ? upload_ranges(host.spheres, host.size, moved.ranges())
                                                : staging_.upload(spheres_, host.spheres, host.size, stream_);
    view.size = host.size;
    view.extent = host.extent;
    stream_.synchronize();
    return view;
  }

  HierarchyView<Sphere> to_device(const HierarchyView<Sphere>& host) override {
    return upload(host, bounds_);
  }
  HierarchyView<Sphere64> to_device(const HierarchyView<Sphere64>& host) override {
    return upload(host, bounds64_);
  }
  HierarchyView<Sphere> to_host(const HierarchyView<Sphere>& device) override {
    return download(device, host_bounds_);
  }
  HierarchyView<Sphere64> to_host(const HierarchyView<Sphere64>& device) override {
    return download(device, host_bounds64_);
  }

  Times run(const Work& work) override {
    const DeviceScope scope(place_);
    Times times;
    do {
      times.work_ms = timer_.time(stream_, [&] { work(stream_); });
    } while (timer_.is_start(times.work_ms, times.start_ms));
    return times;
  }

  void clear(const ResidentAnswer& answer, std::uint32_t n, StreamHandle stream) override {
    clear_answer(answer, n, static_cast<cudaStream_t>(stream));
  }

  Times answer(std::uint32_t n, const Request& request, Collisions& result, const Search& search,
               const std::function<void(const ResidentState&)>& mend) override {
    const DeviceScope scope(place_);
    return answer_.fetch(n, request, result, search, mend, stream_, staging_);
  }

  Times answer_by_graph(std::uint32_t n, const Request& request, Collisions& result, const Search& search,
                        const std::function<void(const ResidentState&)>& mend,
                        const std::function<void()>& before) override {
    const DeviceScope scope(place_);
    return answer_.fetch_by_graph(n, request, result, search, mend, before, stream_, staging_);
  }

  void flush_cache() override {
    const DeviceScope scope(place_);
    int bytes = 0;
    CATENA_CUDA(cudaDeviceGetAttribute(&bytes, cudaDevAttrL2CacheSize, static_cast<int>(place_.index)));
    const std::size_t size = 2 * static_cast<std::size_t>(bytes);
    CATENA_CUDA(cudaMemsetAsync(flushed_.reserve(size, stream_), 0, size, stream_));
    stream_.synchronize();
  }

 private:
  /// Ranges of spheres over those that are there; near ones as one, as every move takes microseconds.
  const Sphere* upload_ranges(const Sphere* host, std::uint32_t n, std::span<const SphereRange> ranges) {
    constexpr std::uint32_t near = 2048;
    Sphere* const there = spheres_.reserve(n, stream_);
    for (std::size_t k = 0; k < ranges.size();) {
      SphereRange range = ranges[k++].within(n);
      while (k < ranges.size() && ranges[k].begin <= range.end + near) range.end = ranges[k++].within(n).end;
      staging_.to_device(there + range.begin, host + range.begin, range.size() * sizeof(Sphere), stream_);
    }
    return there;
  }
  void upload_topology(const ChainView& host) {
    topology_ = {};
    ChainView view = host;
    const std::size_t n = host.size, strands = host.strand_count;
    ExclusionView& rule = view.exclusion;
    const ExclusionView& from = host.exclusion;
    if (!from.one_open_strand) {
      rule.strand_of = staging_.upload(strand_of_, from.strand_of, n, stream_);
      rule.strand_first = staging_.upload(strand_first_, from.strand_first, strands + 1, stream_);
      rule.strand_closed = staging_.upload(strand_closed_, from.strand_closed, strands, stream_);
    }
    if (from.rule == Exclusion::Rule::arc_window) {
      rule.arc = staging_.upload(arc_, from.arc, n, stream_);
      rule.loop_length = staging_.upload(loop_length_, from.loop_length, strands, stream_);
    }
    if (from.extra_row != nullptr) {
      rule.extra_row = staging_.upload(extra_row_, from.extra_row, n + 1, stream_);
      rule.extra = staging_.upload(extra_, from.extra, host.extra_count, stream_);
    }
    stream_.synchronize();
    topology_ = view;
  }
  template <class Bound>
  HierarchyView<Bound> upload(HierarchyView<Bound> tree, DeviceBuffer<Bound>& bounds) {
    const DeviceScope scope(place_);
    tree.bound = staging_.upload<Bound>(bounds, tree.bound, tree.size(), stream_);
    tree.links = staging_.upload<Links>(links_, tree.links, tree.size(), stream_);
    stream_.synchronize();
    return tree;
  }
  template <class Bound>
  HierarchyView<Bound> download(HierarchyView<Bound> tree, std::vector<Bound>& bounds) {
    const DeviceScope scope(place_);
    const std::size_t slots = tree.size();
    bounds.resize(slots);
    host_links_.resize(slots);
    staging_.to_host(bounds.data(), tree.bound, slots * sizeof(Bound), stream_);
    staging_.to_host(host_links_.data(), tree.links, slots * sizeof(Links), stream_);
    tree.bound = bounds.data();
    tree.links = host_links_.data();
    return tree;
  }

  Place place_;
  Stream stream_;
  EventTimer timer_;
  Staging staging_;
  DeviceAnswer answer_;
  ChainView topology_{};  ///< the last one that was moved, with the device's pointers
  DeviceBuffer<Sphere> spheres_, bounds_;
  DeviceBuffer<Sphere64> bounds64_;
  DeviceBuffer<Links> links_;
  DeviceBuffer<std::uint32_t> strand_of_, strand_first_, extra_row_, extra_;
  DeviceBuffer<std::uint8_t> strand_closed_, flushed_;
  DeviceBuffer<double> arc_, loop_length_;
  std::vector<Sphere> host_bounds_;
  std::vector<Sphere64> host_bounds64_;
  std::vector<Links> host_links_;
};

[[maybe_unused]] const bool registered = [] {
  StrategyRegistry::instance().set_device([](Place place) -> std::unique_ptr<Device> {
    require_device(place);
    const DeviceScope scope(place);
    return std::make_unique<CudaDevice>(place);
  });
  return true;
}();

}  // namespace
}  // namespace catena::cuda
