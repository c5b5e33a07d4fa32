#pragma once
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>

namespace catena {

/// Any float that a chain may hold, by its bits: denormals, -0 and the largest are as likely as 1.
inline rc::Gen<float> any_finite() {
  return rc::gen::suchThat(rc::gen::map(rc::gen::arbitrary<std::uint32_t>(),
                                        [](std::uint32_t b) { return std::bit_cast<float>(b); }),
                           [](float value) { return std::isfinite(value); });
}

}  // namespace catena
