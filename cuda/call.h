#pragma once
#include <cuda_runtime.h>

#include <string>

#include "catena/core/error.h"
#include "catena/core/export.h"

static_assert(__cplusplus >= 202002L, "nvcc was not given -std=c++20");

namespace catena::cuda {

/// A CUDA call failed: what() names file, line, call and CUDA's own words.
class CATENA_API CudaError : public Error {
 public:
  CudaError(cudaError_t code, const char* call, const char* file, int line)
      : Error(std::string(file) + ":" + std::to_string(line) + ": " + call + ": " + cudaGetErrorName(code) +
              ": " + cudaGetErrorString(code)) {}
};

/// Throws CudaError when `code` is not success. Clears the last error, so that no later check meets it again;
/// one that has spoilt the context stays, and every later call returns it.
inline void check(cudaError_t code, const char* call, const char* file, int line) {
  if (code == cudaSuccess) return;
  cudaGetLastError();
  throw CudaError(code, call, file, line);
}

}  // namespace catena::cuda

/// Every CUDA runtime call goes through this; a macro because the message shows the call's own text.
#define CATENA_CUDA(call) ::catena::cuda::check((call), #call, __FILE__, __LINE__)
