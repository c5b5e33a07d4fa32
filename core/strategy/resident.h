#pragma once
#include <cstdint>

#include "catena/core/export.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/pair.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// A queue of work of a device, such as a cudaStream_t.
using StreamHandle = void*;

/// How a resident search went; lies on the device, and is written by the search alone.
struct CATENA_API ResidentState {
  unsigned long long found;  ///< pairs found, each once: the true number, also where the buffer was too small
  std::uint32_t overflow;    ///< not 0: something was lost for want of room, and the search must be run again
};

/// Where a resident search leaves its answer: plain pointers on the device, the caller's memory.
struct CATENA_API ResidentAnswer {
  std::uint32_t* count;    ///< n counts; nullptr under Want::any
  Pair* pairs;             ///< nullptr unless pairs are wanted
  std::uint64_t capacity;  ///< of `pairs`; what is found beyond it is counted and sets `overflow`
  ResidentState* state;
};

/// A search whose chain and answer stay on a device. Work is enqueued on the caller's stream and never waited
/// for, so that it may be part of the caller's own pipeline or graph. Memory is taken at the first call for
/// that many spheres, ordered with the stream. One stream at a time.
///
///     search.enqueue_build(chain, request, stream);
///     search.enqueue_find(chain, request, answer, stream);
///     ... later, when the stream is done and `state` was read:
///     if (state.overflow) search.mend(state), give room for state.found pairs, and enqueue the find again
class CATENA_API ResidentSearch {
 public:
  virtual ~ResidentSearch() = default;
  /// Stage 1 on a chain whose pointers are all of the device (Device::to_device makes one). What chain.extent
  /// says is believed, now and whenever work that was recorded is launched again: spheres that moved since
  /// need one that held for all of them; a greater one is right too. Throws CapacityError past a declared
  /// limit on n.
  virtual void enqueue_build(const ChainView& chain, const Request& request, StreamHandle stream) = 0;
  /// Stage 2 on the chain of the last enqueue_build. Writes all of `answer` that is not nullptr, what it held
  /// before is lost. request.pair_limit is the caller's to compare with state.found.
  virtual void enqueue_find(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                            StreamHandle stream) = 0;
  /// Takes the room of its own that a search with overflow lacked. Nothing by default: the answer's buffer is
  /// the caller's.
  virtual void mend(const ResidentState& /*seen*/) {}
};

}  // namespace catena
