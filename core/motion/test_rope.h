#pragma once
#include <memory>
#include <utility>

#include "catena/core/motion/rope.h"
#include "catena/core/strategy/registry.h"

namespace catena::motion {

/// A sphere of radius 1 there.
inline Sphere stored(const Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 1};
}

/// A rope of such spheres, for tests, whose contacts this variant finds.
inline RopeMotion rope(const RopeSettings& settings, const RopeMotion::Start& start,
                       std::unique_ptr<Variant> variant = StrategyRegistry::instance().make("CPU1")) {
  return {settings, start, stored, std::move(variant)};
}

}  // namespace catena::motion
