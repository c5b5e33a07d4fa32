#pragma once
#include <map>
#include <string>

#include "catena/core/export.h"

namespace catena::cuda {

/// What a measurement says of device 0, its driver and the toolkit, or why there is no device. Throws
/// CudaError.
CATENA_API std::map<std::string, std::string> device_facts();

}  // namespace catena::cuda
