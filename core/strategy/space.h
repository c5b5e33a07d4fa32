#pragma once

namespace catena {

/// Where a stage wants its data and leaves its result.
enum class Space { host, device };

}  // namespace catena
