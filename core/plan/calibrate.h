#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/plan/machine.h"

namespace catena {

/// Measures what each variant that says what it costs costs here, on springs of two lengths: about a
/// twentieth of a second each, and again where threads hardly help: in a second or two. One that fails keeps
/// its built-in figures.
CATENA_API Machine calibrate();

/// What a search of so many spheres took.
struct SearchTook {
  std::uint32_t n;
  double us;
};
/// The variant's costs, where those of a search on one thread are a line through two measurements.
CATENA_API MachineCost cost_through(const Machine::VariantCost& v, SearchTook few, SearchTook many);

/// Variants that several cores searched hardly any sooner than one: what is measured while other work keeps
/// the cores busy, and plans then take one thread.
CATENA_API std::vector<std::string> hardly_helped_by_threads(const Machine& machine);

/// The least n from which a tree is cheaper than all pairs; 0 where one of them has no cost.
CATENA_API std::uint32_t crossover(const Machine& machine);

}  // namespace catena
