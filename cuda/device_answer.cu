#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/strategy/timings.h"
#include "catena/cuda/clear_answer.cuh"
#include "catena/cuda/device_answer.h"

namespace catena::cuda {

Device::Times DeviceAnswer::fetch(std::uint32_t n, const Request& request, Collisions& result,
                                  const Device::Search& search,
                                  const std::function<void(const ResidentState&)>& mend, const Stream& stream,
                                  Staging& staging, const CountsTo* counts) {
  try {
    return fetch_all(n, request, result, search, mend, stream, staging, counts);
  } catch (...) {  // what is left of an earlier search is no answer
    result.count.clear();
    std::vector<Pair>().swap(result.pairs);
    throw;
  }
}

Device::Times DeviceAnswer::fetch_all(std::uint32_t n, const Request& request, Collisions& result,
                                      const Device::Search& search,
                                      const std::function<void(const ResidentState&)>& mend,
                                      const Stream& stream, Staging& staging, const CountsTo* counts) {
  ResidentAnswer answer = prepare(n, request, result, stream);
  Device::Times times;
  ResidentState state{};
  for (;;) {
    clear_answer(answer, n, stream);
    const double work_ms = timer_.time(stream, [&] { search(answer, stream); });
    if (timer_.is_start(work_ms, times.start_ms)) continue;
    times.work_ms += work_ms;
    const Stopwatch watch;
    CATENA_CUDA(cudaMemcpyAsync(&state, answer.state, sizeof state, cudaMemcpyDeviceToHost, stream));
    stream.synchronize();
    times.transfer_ms += watch.ms();
    const bool pairs = request.want == Request::Want::pairs;
    if (pairs && state.found > request.pair_limit) throw PairLimitExceeded(state.found, request.pair_limit);
    if (state.overflow == 0) break;
    mend(state);
    if (pairs && state.found > answer.capacity) {
      answer.capacity = state.found;
      answer.pairs = pairs_.reserve(state.found, stream);
    }
  }
  result.found = state.found > 0;
  if (request.want == Request::Want::any) return times;
  result.pair_count = state.found;
  const Stopwatch watch;
  if (counts == nullptr) {
    resize_large(result.count, n);
    staging.to_host(result.count.data(), answer.count, n * sizeof *answer.count, stream);
  } else {
    staging.to_host(counts->count.data(), answer.count + counts->first, counts->count.size_bytes(), stream);
  }
  if (request.want == Request::Want::pairs) {
    resize_large(result.pairs, state.found);
    staging.to_host(result.pairs.data(), answer.pairs, state.found * sizeof(Pair), stream);
  }
  times.transfer_ms += watch.ms();
  return times;
}

ResidentAnswer DeviceAnswer::prepare(std::uint32_t n, const Request& request, Collisions& result,
                                     cudaStream_t stream) {
  result.found = false;
  result.pair_count = 0;
  const bool counts = request.want != Request::Want::any, pairs = request.want == Request::Want::pairs;
  // What is wanted is kept until the device overwrites it: to clear it first takes as long as to move it.
  if (!counts) result.count.clear();
  if (!pairs) result.pairs.clear();
  // A first guess of one pair in two spheres; kept from search to search.
  const std::uint64_t guess = std::max<std::uint64_t>({pairs_.capacity(), n / 2, 1024});
  const std::uint64_t capacity = pairs ? std::max<std::uint64_t>(1, std::min(guess, request.pair_limit)) : 0;
  return {counts ? count_.reserve(n, stream) : nullptr, pairs ? pairs_.reserve(capacity, stream) : nullptr,
          capacity, state_.reserve(1, stream)};
}

}  // namespace catena::cuda
