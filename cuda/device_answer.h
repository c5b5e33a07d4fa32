#pragma once
#include <cstdint>
#include <span>

#include "catena/core/strategy/device.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/staging.h"
#include "catena/cuda/stream.h"

namespace catena::cuda {

/// The buffers that searches of one host object leave their answers in, reused from search to search.
class DeviceAnswer {
 public:
  /// Where the counts of consecutive spheres go instead of the result: as many as `count` has, those of the
  /// spheres from `first` on.
  struct CountsTo {
    std::uint32_t first;
    std::span<std::uint32_t> count;
  };

  /// Runs `search` on the stream until nothing was lost, then copies the answer to the host: counts are
  /// complete at the first run; when the pair buffer was too small it grows to the true number and the search
  /// runs again, told by `mend`. Throws PairLimitExceeded with the true number.
  Device::Times fetch(std::uint32_t n, const Request& request, Collisions& result,
                      const Device::Search& search, const std::function<void(const ResidentState&)>& mend,
                      const Stream& stream, Staging& staging, const CountsTo* counts = nullptr);
  /// The same, and the answer is that of a launch of the search as one graph, whose time is given: see
  /// Device::answer_by_graph().
  Device::Times fetch_by_graph(std::uint32_t n, const Request& request, Collisions& result,
                               const Device::Search& search,
                               const std::function<void(const ResidentState&)>& mend,
                               const std::function<void()>& before, const Stream& stream, Staging& staging);

 private:
  /// Where the answer is, on the device, once nothing was lost.
  struct Found {
    ResidentAnswer answer;
    ResidentState state;
  };
  Found search_all(std::uint32_t n, const Request& request, Collisions& result, const Device::Search& search,
                   const std::function<void(const ResidentState&)>& mend, const Stream& stream,
                   Device::Times& times);
  static void fetch_state(Found& found, const Stream& stream, Device::Times& times);
  static void to_host(std::uint32_t n, const Request& request, const Found& found, Collisions& result,
                      const Stream& stream, Staging& staging, const CountsTo* counts, Device::Times& times);
  ResidentAnswer prepare(std::uint32_t n, const Request& request, Collisions& result, cudaStream_t stream);
  DeviceBuffer<std::uint32_t> count_;
  DeviceBuffer<Pair> pairs_;
  DeviceBuffer<ResidentState> state_;
  EventTimer timer_;
};

}  // namespace catena::cuda
