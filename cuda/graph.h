#pragma once
#include <cuda_runtime.h>

#include "catena/cuda/call.h"

namespace catena::cuda {

/// What is enqueued on a stream, recorded instead of run, to be launched as one piece of work.
class Graph {
 public:
  /// `work` enqueues on the stream, which it neither waits for nor takes memory from.
  template <class Work>
  Graph(cudaStream_t stream, const Work& work) {
    CATENA_CUDA(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal));
    cudaGraph_t recorded = nullptr;
    try {
      work();
    } catch (...) {
      cudaStreamEndCapture(stream, &recorded);
      cudaGraphDestroy(recorded);
      throw;
    }
    CATENA_CUDA(cudaStreamEndCapture(stream, &recorded));
    const cudaError_t made = cudaGraphInstantiate(&graph_, recorded, 0);
    cudaGraphDestroy(recorded);
    check(made, "cudaGraphInstantiate", __FILE__, __LINE__);
    const cudaError_t uploaded = cudaGraphUpload(graph_, stream);
    if (uploaded != cudaSuccess) cudaGraphExecDestroy(graph_);  // a constructor that throws has no destructor
    check(uploaded, "cudaGraphUpload", __FILE__, __LINE__);
  }
  ~Graph() { cudaGraphExecDestroy(graph_); }
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  void launch(cudaStream_t stream) const { CATENA_CUDA(cudaGraphLaunch(graph_, stream)); }

 private:
  cudaGraphExec_t graph_ = nullptr;
};

}  // namespace catena::cuda
