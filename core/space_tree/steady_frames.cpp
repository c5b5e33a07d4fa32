#include "catena/core/space_tree/steady_frames.h"

#include <algorithm>
#include <cmath>

#include "catena/core/scattered.h"

namespace catena {
namespace {

const Sphere& sample_of(const ChainView& chain, std::uint32_t k, std::uint32_t samples) {
  return chain.spheres[sample_along(k, samples, chain.size)];
}

/// How far it moved and grew, in its radii.
double change(const Sphere& then, const Sphere& now) {
  const double dx = double{now.x} - then.x, dy = double{now.y} - then.y, dz = double{now.z} - then.z;
  return (std::sqrt(dx * dx + dy * dy + dz * dz) + std::abs(double{now.radius} - then.radius)) / then.radius;
}

}  // namespace

void SteadyFrames::looked(const ChainView& chain) {
  spheres_ = chain.size;
  samples_ = std::min(most_samples, chain.size);
  frames_ = 0;
  for (std::uint32_t k = 0; k < samples_; ++k) sample_[k] = sample_of(chain, k, samples_);
}

bool SteadyFrames::still(const ChainView& chain) {
  constexpr std::uint32_t most_frames = 16, rare = 16;
  constexpr double little = 0.5;
  if (samples_ == 0 || spheres_ != chain.size || ++frames_ > most_frames) return false;
  std::uint32_t moved = 0;
  for (std::uint32_t k = 0; k < samples_; ++k)
    moved += !(change(sample_[k], sample_of(chain, k, samples_)) <= little);  // without a radius neither
  return moved * rare <= samples_;
}

}  // namespace catena
