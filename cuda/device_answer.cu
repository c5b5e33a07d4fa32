#include <algorithm>
#include <stdexcept>

#include "catena/core/error.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/strategy/timings.h"
#include "catena/cuda/clear_answer.cuh"
#include "catena/cuda/device_answer.h"
#include "catena/cuda/graph.h"

namespace catena::cuda {

namespace {

/// What is left of an earlier search is no answer.
template <class Work>
void or_nothing(Collisions& result, const Work& work) {
  try {
    work();
  } catch (...) {
    result.count.clear();
    std::vector<Pair>().swap(result.pairs);
    throw;
  }
}

}  // namespace

Device::Times DeviceAnswer::fetch(std::uint32_t n, const Request& request, Collisions& result,
                                  const Device::Search& search,
                                  const std::function<void(const ResidentState&)>& mend, const Stream& stream,
                                  Staging& staging, const CountsTo* counts) {
  Device::Times times;
  or_nothing(result, [&] {
    const Found found = search_all(n, request, result, search, mend, stream, times);
    to_host(n, request, found, result, stream, staging, counts, times);
  });
  return times;
}

Device::Times DeviceAnswer::fetch_by_graph(std::uint32_t n, const Request& request, Collisions& result,
                                           const Device::Search& search,
                                           const std::function<void(const ResidentState&)>& mend,
                                           const std::function<void()>& before, const Stream& stream,
                                           Staging& staging) {
  Device::Times times;
  or_nothing(result, [&] {
    Found found = search_all(n, request, result, search, mend, stream, times);
    const Graph graph(stream, [&] { search(found.answer, stream); });
    clear_answer(found.answer, n, stream);  // so that what comes back is the graph's
    before();
    times.work_ms = timer_.time(stream, [&] { graph.launch(stream); });
    fetch_state(found, stream, times);
    to_host(n, request, found, result, stream, staging, nullptr, times);
  });
  return times;
}

DeviceAnswer::Found DeviceAnswer::search_all(std::uint32_t n, const Request& request, Collisions& result,
                                             const Device::Search& search,
                                             const std::function<void(const ResidentState&)>& mend,
                                             const Stream& stream, Device::Times& times) {
  Found found{prepare(n, request, result, stream), {}};
  auto& [answer, state] = found;
  constexpr int most_searches = 64;  // of one that makes room for what it saw to be too little; mostly 1 or 2
  for (int searches = 0; searches < most_searches; ++searches) {
    clear_answer(answer, n, stream);
    const double work_ms = timer_.time(stream, [&] { search(answer, stream); });
    if (timer_.is_start(work_ms, times.start_ms)) continue;
    times.work_ms += work_ms;
    fetch_state(found, stream, times);
    const bool pairs = request.want == Request::Want::pairs;
    if (pairs && state.found > request.pair_limit) throw PairLimitExceeded(state.found, request.pair_limit);
    if (state.overflow == 0) return found;
    mend(state);
    if (pairs && state.found > answer.capacity) {
      answer.capacity = state.found;
      answer.pairs = pairs_.reserve(state.found, stream);
    }
  }
  throw std::logic_error("a search on a device has too little room, however often it is mended");
}

void DeviceAnswer::fetch_state(Found& found, const Stream& stream, Device::Times& times) {
  const Stopwatch watch;
  CATENA_CUDA(
      cudaMemcpyAsync(&found.state, found.answer.state, sizeof found.state, cudaMemcpyDeviceToHost, stream));
  stream.synchronize();
  times.transfer_ms += watch.ms();
}

void DeviceAnswer::to_host(std::uint32_t n, const Request& request, const Found& found, Collisions& result,
                           const Stream& stream, Staging& staging, const CountsTo* counts,
                           Device::Times& times) {
  const auto& [answer, state] = found;
  result.found = state.found > 0;
  if (request.want == Request::Want::any) return;
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
