#pragma once
#include <cuda_runtime.h>

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

/// Milliseconds on the device between start and stop of one stage.
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

  void start(cudaStream_t stream) { CATENA_CUDA(cudaEventRecord(begin_, stream)); }
  void stop(cudaStream_t stream) { CATENA_CUDA(cudaEventRecord(end_, stream)); }
  /// Waits for stop.
  double ms() const {
    float elapsed = 0;
    CATENA_CUDA(cudaEventSynchronize(end_));
    CATENA_CUDA(cudaEventElapsedTime(&elapsed, begin_, end_));
    return elapsed;
  }

 private:
  cudaEvent_t begin_ = nullptr, end_ = nullptr;
};

}  // namespace catena::cuda
