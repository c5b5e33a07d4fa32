#pragma once
#include <algorithm>
#include <optional>
#include <string>

#include "catena/core/strategy/registry.h"

namespace catena::properties {

/// Why no variant runs on a device here; nothing where they do.
inline std::optional<std::string> no_device() {
  const auto variants = StrategyRegistry::instance().variants();
  const auto one =
      std::ranges::find_if(variants, [](const VariantInfo& variant) { return variant.name == "DeviceGrid"; });
  return one == variants.end() ? "built without CUDA" : one->unavailable;
}

}  // namespace catena::properties
