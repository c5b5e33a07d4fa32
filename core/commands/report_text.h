#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace catena {

/// The width, in characters, of a column that shows these names and is at least `least` wide.
inline std::size_t widest(const std::vector<std::string>& names, std::size_t least) {
  for (const auto& name : names) least = std::max(least, name.size());
  return least;
}

/// JSON has no infinity; a margin or shortfall without a finite value is written as the word.
inline nlohmann::ordered_json finite_or_word(double value) {
  if (std::isfinite(value)) return value;
  return "infinite";
}

}  // namespace catena
