#pragma once
#include <cstdint>
#include <optional>

#include "catena/properties/property.h"

namespace catena::properties {

/// The lengths of chains that a variant may refuse by a CapacityError, and must.
struct DeclaredLimit {
  std::uint32_t takes;         ///< a chain of so many spheres is never refused
  std::uint32_t refuses_past;  ///< a longer one always is
};

/// Only bGPU2 declares one: a single block takes two spheres a thread. nullopt: every chain is taken.
std::optional<DeclaredLimit> declared_limit(const Subject& subject);

/// True when a property may meet a refusal on n spheres: one of them, subdivision, asks of twice as many.
bool may_refuse(const std::optional<DeclaredLimit>& limit, std::uint32_t n);

}  // namespace catena::properties
