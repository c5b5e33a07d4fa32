#pragma once
#include <optional>
#include <string>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/place.h"

namespace catena::cuda {

/// Why no GPU strategy can run here ("no CUDA device: ..."), or nullopt when device 0 can be used. Asked
/// once.
CATENA_API std::optional<std::string> unavailable();
/// Whether that has been asked: a device there is has been started, then.
bool started();

/// Throws CapacityError, naming how many there are, when there is no such device.
void require_device(Place place);

/// Threads that one block of this kernel may have on the current device, which may be fewer than the device's
/// limit.
unsigned most_block_threads(const void* kernel);

/// The parameter by which a strategy is given another device than the first.
inline ParameterInfo device_parameter() { return {"device", "0", "which device, as CUDA counts them"}; }
/// A strategy's parameters with that one.
inline std::vector<ParameterInfo> with_device(std::vector<ParameterInfo> own) {
  own.push_back(device_parameter());
  return own;
}
inline Place device_of(const Parameters& parameters) {
  return Place::device(static_cast<std::uint32_t>(parameters.unsigned_integer("device", 0, 1023)));
}

/// Makes a device the current one of this thread while it lives.
class DeviceScope {
 public:
  explicit DeviceScope(Place place);
  ~DeviceScope();
  DeviceScope(const DeviceScope&) = delete;
  DeviceScope& operator=(const DeviceScope&) = delete;

 private:
  int before_ = 0;
};

}  // namespace catena::cuda
