#pragma once
#include <cstdint>

#include "catena/core/strategy/request.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/stream.h"

namespace catena::cuda {

/// Where the threads of one search write; plain pointers on the device.
struct ResultView {
  std::uint32_t* count;       ///< n counts; nullptr under Want::any
  Pair* pairs;                ///< nullptr unless pairs are wanted
  std::uint64_t capacity;     ///< of pairs; pairs beyond it are counted, not written
  unsigned long long* found;  ///< pairs found so far, each once
  bool any_only;              ///< threads may leave as soon as *found > 0
};

/// Result buffers of one strategy on the device, reused from search to search.
class DeviceResult {
 public:
  /// Runs `launch(view)` until nothing was lost, then copies the result to the host: counts are complete at
  /// the first run; when the pair buffer was too small it grows to the true number and the search runs again.
  /// Throws PairLimitExceeded with the true number.
  template <class Launch>
  void run(std::uint32_t n, const Request& request, Collisions& result, const Stream& stream,
           const Launch& launch) {
    ResultView view = prepare(n, request, result, stream);
    transfer_ms_ = 0;
    find_ms_ = 0;
    for (;;) {
      clear(view, n, stream);
      find_timer_.start(stream);
      launch(view);
      find_timer_.stop(stream);
      find_ms_ += find_timer_.ms();
      if (fits(view, request, result, stream)) break;
    }
    download(view, n, result, stream);
  }

  double find_ms() const { return find_ms_; }          ///< kernels of the last run, CUDA events
  double transfer_ms() const { return transfer_ms_; }  ///< copies of the last run, wall time

 private:
  ResultView prepare(std::uint32_t n, const Request& request, Collisions& result, const Stream& stream);
  void clear(const ResultView& view, std::uint32_t n, const Stream& stream);
  /// Reads the number of pairs; false when the pair buffer was too small, which has then grown.
  bool fits(ResultView& view, const Request& request, Collisions& result, const Stream& stream);
  void download(const ResultView& view, std::uint32_t n, Collisions& result, const Stream& stream);

  DeviceBuffer<std::uint32_t> count_;
  DeviceBuffer<Pair> pairs_;
  DeviceBuffer<unsigned long long> found_;
  EventTimer find_timer_;
  double find_ms_ = 0, transfer_ms_ = 0;
};

}  // namespace catena::cuda
