#pragma once
#include "catena/core/export.h"
#include "catena/core/plan/machine.h"

namespace catena {

/// Measures what each variant that says what it costs costs here, on springs of two lengths: about a
/// twentieth of a second each. One that fails keeps its built-in figures.
CATENA_API Machine calibrate();

/// The least n from which a tree is cheaper than all pairs; 0 where one of them has no cost.
CATENA_API std::uint32_t crossover(const Machine& machine);

}  // namespace catena
