#pragma once
#include <cstdint>
#include <type_traits>

namespace catena::cuda {

/// Sets what lies there to 0, by all threads of a block: for the first kernel of several, as memory that is
/// set by an operation of its own costs a graph nearly a microsecond more.
template <class State>
__device__ void clear_by_block(State* state) {
  static_assert(std::is_trivially_copyable_v<State> && alignof(State) >= alignof(std::uint32_t));
  auto* const words = reinterpret_cast<std::uint32_t*>(state);
  for (std::uint32_t k = threadIdx.x; k < sizeof(State) / sizeof(std::uint32_t); k += blockDim.x)
    words[k] = 0;
}

}  // namespace catena::cuda
