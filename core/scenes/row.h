#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "catena/core/sphere.h"

namespace catena {

/// Spheres one after the other along a tube, of which a stretch can be made without the others being kept.
class Row {
 public:
  /// The next sphere at each call.
  using Walk = std::function<Sphere()>;

  /// Sphere i is at(i): a stretch costs as much as it is long.
  static Row by_number(std::uint32_t size, std::function<Sphere(std::uint32_t i)> at);
  /// Each sphere follows from those before it: `start` begins at the first of them again, so that a stretch
  /// costs as much as all up to its end.
  static Row by_steps(std::uint32_t size, std::function<Walk()> start);

  std::uint32_t size() const { return size_; }
  /// Spheres first, ..., end - 1, the same whatever stretch they are asked in. Memory for those alone. Throws
  /// as the scene's setup does for one of them, or by steps for any up to the end.
  std::vector<Sphere> spheres(std::uint32_t first, std::uint32_t end) const;

 private:
  using From = std::function<Walk(std::uint32_t first)>;
  Row(std::uint32_t size, From from) : size_(size), from_(std::move(from)) {}

  std::uint32_t size_;
  From from_;
};

}  // namespace catena
