#pragma once
#include <optional>
#include <string>

namespace catena::cuda {

/// Why no GPU strategy can run here ("no CUDA device: ..."), or nullopt when device 0 can be used. Asked
/// once.
std::optional<std::string> unavailable();

/// Threads that one block of device 0 may have.
unsigned max_block_threads();

}  // namespace catena::cuda
