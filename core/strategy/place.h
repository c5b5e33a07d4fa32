#pragma once
#include <cstdint>

#include "catena/core/export.h"

namespace catena {

/// The memory where a stage wants its data and leaves its result: the host's, or that of device k.
struct CATENA_API Place {
  enum class Kind { host, device };
  Kind kind = Kind::host;
  std::uint32_t index = 0;  ///< of the device, as its driver counts; 0 for the host

  static constexpr Place host() { return {}; }
  static constexpr Place device(std::uint32_t k = 0) { return {Kind::device, k}; }
  constexpr bool on_device() const { return kind == Kind::device; }
  friend bool operator==(const Place&, const Place&) = default;
};

}  // namespace catena
