#pragma once
#include "catena/core/export.h"
#include "catena/core/strategy/cost.h"

namespace catena {

/// What a search costs on one thread and on several.
struct CATENA_API MachineCost : Cost {
  double serial = 1;   ///< share of sphere_ns that no other thread takes part in; 1: it knows no threads
  double team_us = 0;  ///< whatever n is, of having more than one thread

  double ms(std::uint32_t n, unsigned threads = 1) const {
    const double saved = threads > 1 ? (1 - serial) * (1 - 1.0 / threads) * sphere_ns * n * 1e-6 : 0;
    return Cost::ms(n) - saved + (threads > 1 ? team_us * 1e-3 : 0);
  }
  friend bool operator==(const MachineCost&, const MachineCost&) = default;
};

}  // namespace catena
