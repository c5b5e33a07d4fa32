#pragma once
#include <memory>
#include <string>

#include "catena/core/parts/part_search.h"
#include "catena/core/strategy/place.h"

namespace catena::cuda {

/// Searches parts on a device by a variant that has a resident search, on a stream of its own, so that
/// several such objects share a device. Throws CapacityError when there is no such device.
std::unique_ptr<parts::PartSearch> make_part_on_device(Place place, const std::string& variant);

}  // namespace catena::cuda
