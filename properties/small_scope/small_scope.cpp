#include "catena/properties/small_scope/small_scope.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace catena::properties {

/// Depth first over prefixes. A prefix with an image below it (in lexical order) begins only chains that have
/// one too, and is left at once; of the chains that remain the smallest of each class is visited.
struct SmallScope::Walk {
  const SmallScope& scope;
  const std::function<bool(const std::vector<Sphere>&)>& visit;
  Sum& sum;
  std::vector<State> chain;
  std::vector<Sphere> spheres;
  bool stopped = false;

  /// -1, 0, 1: the image of the chain, read from its end when reversed, is below, equal to, or above it.
  int compare(const std::vector<State>& image, std::uint32_t length, bool reversed) const {
    for (std::uint32_t k = 0; k < length; ++k) {
      const State other = image[chain[reversed ? length - 1 - k : k]];
      if (other != chain[k]) return other < chain[k] ? -1 : 1;
    }
    return 0;
  }

  void extend(std::uint32_t at) {
    const auto n = static_cast<std::uint32_t>(chain.size());
    if (at == n) return finish();
    for (std::size_t state = 0; state < scope.spheres_.size() && !stopped; ++state) {
      chain[at] = static_cast<State>(state);
      spheres[at] = scope.spheres_[state];
      const bool least = std::ranges::none_of(
          scope.images_, [&](const auto& image) { return compare(image, at + 1, false) < 0; });
      if (least) extend(at + 1);
    }
  }

  void finish() {
    const auto n = static_cast<std::uint32_t>(chain.size());
    std::uint64_t same = 0;
    for (const auto& image : scope.images_) {
      const int turned = compare(image, n, true);
      if (turned < 0) return;
      same += compare(image, n, false) == 0;
      same += turned == 0;
    }
    ++sum.visited;
    sum.stood_for += scope.symmetries() / same;  // the orbit: all symmetries by those that change nothing
    stopped = !visit(spheres);
  }
};

SmallScope::SmallScope(const World& world) {
  const std::array<int, 3> length{world.width, world.height, world.depth};
  std::vector<std::array<int, 3>> places;
  for (int x = 0; x < length[0]; ++x)
    for (int y = 0; y < length[1]; ++y)
      for (int z = 0; z < length[2]; ++z) places.push_back({x, y, z});
  const std::size_t radii = world.radii.size();
  if (places.size() * radii > 256) throw std::logic_error("SmallScope: too many states");
  for (const auto& p : places)
    for (const float radius : world.radii)
      spheres_.push_back({float(p[0]), float(p[1]), float(p[2]), radius});

  std::array<int, 3> axes{0, 1, 2};
  do {
    const auto same = [&](std::size_t k) { return length[static_cast<std::size_t>(axes[k])] == length[k]; };
    const bool fits = same(0) && same(1) && same(2);
    for (unsigned mirror = 0; fits && mirror < 8; ++mirror) {
      std::vector<State> image;
      for (const auto& p : places) {
        std::array<int, 3> q{};
        for (unsigned k = 0; k < 3; ++k) {
          const int along = p[static_cast<std::size_t>(axes[k])];
          q[k] = mirror >> k & 1 ? length[k] - 1 - along : along;
        }
        const auto place = static_cast<std::size_t>(std::ranges::find(places, q) - places.begin());
        for (std::size_t r = 0; r < radii; ++r) image.push_back(static_cast<State>(place * radii + r));
      }
      if (std::ranges::find(images_, image) == images_.end()) images_.push_back(std::move(image));
    }
  } while (std::ranges::next_permutation(axes).found);
}

SmallScope::Sum SmallScope::for_each(std::uint32_t n,
                                     const std::function<bool(const std::vector<Sphere>&)>& visit) const {
  Sum sum;
  Walk walk{*this, visit, sum, std::vector<State>(n), std::vector<Sphere>(n)};
  walk.extend(0);
  return sum;
}

}  // namespace catena::properties
