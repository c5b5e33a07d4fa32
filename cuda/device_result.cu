#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/strategy/timings.h"
#include "catena/cuda/device_result.h"

namespace catena::cuda {

ResultView DeviceResult::prepare(std::uint32_t n, const Request& request, Collisions& result,
                                 const Stream& stream) {
  result.found = false;
  result.pair_count = 0;
  result.pairs.clear();
  const bool counts = request.want != Request::Want::any, pairs = request.want == Request::Want::pairs;
  result.count.assign(counts ? n : 0, 0);
  // A first guess of one pair in two spheres; kept from search to search.
  const std::uint64_t guess = std::max<std::uint64_t>({pairs_.capacity(), n / 2, 1024});
  const std::uint64_t capacity = pairs ? std::max<std::uint64_t>(1, std::min(guess, request.pair_limit)) : 0;
  return {counts ? count_.reserve(n, stream) : nullptr, pairs ? pairs_.reserve(capacity, stream) : nullptr,
          capacity, found_.reserve(1, stream), !counts};
}

void DeviceResult::clear(const ResultView& view, std::uint32_t n, const Stream& stream) {
  CATENA_CUDA(cudaMemsetAsync(view.found, 0, sizeof *view.found, stream));
  if (view.count != nullptr && n > 0)
    CATENA_CUDA(cudaMemsetAsync(view.count, 0, n * sizeof *view.count, stream));
}

bool DeviceResult::fits(ResultView& view, const Request& request, Collisions& result, const Stream& stream) {
  unsigned long long found = 0;
  const Stopwatch watch;
  CATENA_CUDA(cudaMemcpyAsync(&found, view.found, sizeof found, cudaMemcpyDeviceToHost, stream));
  stream.synchronize();
  transfer_ms_ += watch.ms();
  result.found = found > 0;
  if (view.any_only) return true;
  result.pair_count = found;
  if (view.pairs == nullptr) return true;
  if (found > request.pair_limit) throw PairLimitExceeded(found, request.pair_limit);
  if (found <= view.capacity) return true;
  view.capacity = found;
  view.pairs = pairs_.reserve(found, stream);
  return false;
}

void DeviceResult::download(const ResultView& view, std::uint32_t n, Collisions& result,
                            const Stream& stream) {
  const Stopwatch watch;
  if (view.count != nullptr && n > 0)
    CATENA_CUDA(cudaMemcpyAsync(result.count.data(), view.count, n * sizeof *view.count,
                                cudaMemcpyDeviceToHost, stream));
  if (view.pairs != nullptr && result.pair_count > 0) {
    result.pairs.resize(result.pair_count);
    CATENA_CUDA(cudaMemcpyAsync(result.pairs.data(), view.pairs, result.pair_count * sizeof(Pair),
                                cudaMemcpyDeviceToHost, stream));
  }
  stream.synchronize();
  transfer_ms_ += watch.ms();
}

}  // namespace catena::cuda
