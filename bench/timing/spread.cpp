#include "catena/bench/timing/spread.h"

#include <algorithm>
#include <cmath>

namespace catena::bench {

Spread Spread::of(std::vector<double> samples) {
  std::ranges::sort(samples);
  const auto at = [&](double share) {  // linear between neighbours, as most statistics programs do
    const double place = share * static_cast<double>(samples.size() - 1), below = std::floor(place);
    const auto k = static_cast<std::size_t>(below);
    const double next = samples[std::min(k + 1, samples.size() - 1)];
    return samples[k] + (place - below) * (next - samples[k]);
  };
  return {samples.front(), at(0.25), at(0.5), at(0.75)};
}

}  // namespace catena::bench
