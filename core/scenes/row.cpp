#include "catena/core/scenes/row.h"

#include <algorithm>
#include <stdexcept>

#include "catena/core/executor/large_vector.h"

namespace catena {

Row Row::by_number(std::uint32_t size, std::function<Sphere(std::uint32_t)> at) {
  return {size, [at = std::move(at)](std::uint32_t first) -> Walk {
            return [at, i = first]() mutable { return at(i++); };
          }};
}

Row Row::by_steps(std::uint32_t size, std::function<Walk()> start) {
  return {size, [start = std::move(start)](std::uint32_t first) {
            Walk walk = start();
            for (std::uint32_t i = 0; i < first; ++i) walk();
            return walk;
          }};
}

std::vector<Sphere> Row::spheres(std::uint32_t first, std::uint32_t end) const {
  if (first > end || end > size_) throw std::out_of_range("a stretch beyond the row");
  std::vector<Sphere> stretch;
  if (first == end) return stretch;
  resize_large(stretch, end - first);
  std::ranges::generate(stretch, from_(first));
  return stretch;
}

}  // namespace catena
