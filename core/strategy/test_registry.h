#pragma once
#include <string>

#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"

namespace catena::test {

inline const StrategyRegistry& registry() { return StrategyRegistry::instance(); }

/// Why there is no variant of this name; empty where there is one.
inline std::string refusal(const std::string& name) {
  try {
    registry().make(name);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace catena::test
