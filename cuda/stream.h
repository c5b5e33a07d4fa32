#pragma once
#include <cuda_runtime.h>

#include "catena/core/strategy/timings.h"
#include "catena/cuda/call.h"

namespace catena::cuda {

/// An owned, non-blocking stream.
class Stream {
 public:
  Stream() { CATENA_CUDA(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking)); }
  ~Stream() { cudaStreamDestroy(stream_); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  operator cudaStream_t() const { return stream_; }
  void synchronize() const { CATENA_CUDA(cudaStreamSynchronize(stream_)); }

 private:
  cudaStream_t stream_ = nullptr;
};

/// The time of one stage, by the device's clock.
class EventTimer {
 public:
  EventTimer() {
    CATENA_CUDA(cudaEventCreate(&begin_));
    CATENA_CUDA(cudaEventCreate(&end_));
  }
  ~EventTimer() {
    cudaEventDestroy(begin_);
    cudaEventDestroy(end_);
  }
  EventTimer(const EventTimer&) = delete;
  EventTimer& operator=(const EventTimer&) = delete;

  /// Milliseconds on the device of what `work` enqueues on the stream; waits for it.
  template <class Work>
  double time(cudaStream_t stream, const Work& work) {
    const Stopwatch enqueuing;
    CATENA_CUDA(cudaEventRecord(begin_, stream));
    work();
    CATENA_CUDA(cudaEventRecord(end_, stream));
    enqueuing_ms_ = enqueuing.ms();
    float elapsed = 0;
    CATENA_CUDA(cudaEventSynchronize(end_));
    CATENA_CUDA(cudaEventElapsedTime(&elapsed, begin_, end_));
    return elapsed;
  }

  /// True where that time is of a first start: the host took most of it to enqueue, as code was loaded. Adds
  /// what it took to `start_ms`, once; the work is to be timed anew.
  bool is_start(double ms, double& start_ms) const {
    constexpr double longest_launch_ms = 1;  // microseconds, but for one that loads code
    if (start_ms > 0 || enqueuing_ms_ < longest_launch_ms || enqueuing_ms_ < ms / 2) return false;
    start_ms = enqueuing_ms_;
    return true;
  }

 private:
  cudaEvent_t begin_ = nullptr, end_ = nullptr;
  double enqueuing_ms_ = 0;
};

}  // namespace catena::cuda
