#pragma once
#include <cstdint>
#include <vector>

#include "hwy/contrib/sort/vqsort.h"

namespace catena {

/// Sorts points along a Morton curve: what is near in the order is near in space. Keeps its memory.
class SpaceOrder {
 public:
  struct Point {
    float x, y, z;
  };

  /// The indices of the points in their order. A curve of 2^10 cells a side over the box of all points. O(n) but for the
  /// sort.
  const std::vector<std::uint32_t>& of(const std::vector<Point>& points);

 private:
  std::vector<std::uint64_t> keys_;  ///< place on the curve, index
  std::vector<std::uint32_t> order_;
  hwy::Sorter sort_;
};

}  // namespace catena
