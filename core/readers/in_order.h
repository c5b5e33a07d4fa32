#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace catena {

/// The values at these places, each named once, in this order, instead of all.
template <class T>
void put_in_order(std::vector<T>& values, std::span<const std::uint32_t> order) {
  if (order.size() == values.size() && std::ranges::is_sorted(order)) return;
  std::vector<T> chosen;
  chosen.reserve(order.size());
  for (const std::uint32_t k : order) chosen.push_back(values[k]);
  values = std::move(chosen);
}

}  // namespace catena
