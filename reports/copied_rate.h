#pragma once

namespace catena::reports {

/// Of memory, in GB/s, where copying so many bytes took so long: each is read and written.
inline double copied_gb_s(double bytes, double ms) { return 2 * bytes / (ms * 1e6); }

}  // namespace catena::reports
