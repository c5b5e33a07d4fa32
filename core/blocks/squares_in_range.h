#pragma once

namespace catena {

/// Whether squares of distances such as this radius keep their digits in binary32. Where they do not, the
/// chain's order scales its numbers; single spheres leave each pair that is near to the exact stage.
inline bool squares_in_range(float radius) { return radius == 0 || (radius > 0x1p-44f && radius < 0x1p58f); }

}  // namespace catena
