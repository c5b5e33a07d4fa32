#include "catena/core/parts/regions.h"

#include <algorithm>

#include "catena/core/hierarchy/morton_grid.h"

namespace catena::parts {
namespace {

float coordinate(const Sphere& s, int axis) { return axis == 0 ? s.x : axis == 1 ? s.y : s.z; }

int longest_side(std::span<const Sphere> sample) {
  CentreCorners corners;
  for (const Sphere& s : sample) corners.take(s);
  int longest = 0;
  double most = -1;
  for (int axis = 0; axis < 3; ++axis)
    if (const double side = double{coordinate(corners.high, axis)} - coordinate(corners.low, axis);
        side > most)
      longest = axis, most = side;
  return longest;
}

}  // namespace

Regions::Regions(std::span<const Sphere> spheres, std::uint32_t count) {
  const std::size_t most = std::max<std::size_t>(1u << 15, std::size_t{count} * 64);
  const std::size_t step = std::max<std::size_t>(1, spheres.size() / most);
  std::vector<Sphere> sample;
  for (std::size_t k = step / 2; k < spheres.size(); k += step) sample.push_back(spheres[k]);
  cut(sample, 0, count);
}

void Regions::cut(std::span<Sphere> sample, std::uint32_t first, std::uint32_t count) {
  const std::size_t at = cuts_.size();
  cuts_.push_back({.region = first});
  if (count == 1) return;
  const int axis = longest_side(sample);
  const std::uint32_t before = count / 2;
  const std::size_t middle = sample.size() * before / count;
  cuts_[at].axis = axis;
  if (!sample.empty()) {
    std::nth_element(
        sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(middle), sample.end(),
        [axis](const Sphere& a, const Sphere& b) { return coordinate(a, axis) < coordinate(b, axis); });
    cuts_[at].at = coordinate(sample[middle], axis);
  }
  cut(sample.subspan(0, middle), first, before);
  cuts_[at].second = static_cast<std::uint32_t>(cuts_.size());
  cut(sample.subspan(middle), first + before, count - before);
}

void Regions::enclose(std::span<const Box> contents) {
  around_.resize(cuts_.size());
  for (std::size_t at = cuts_.size(); at-- > 0;) {  // what follows a cut is of it
    const Cut& cut = cuts_[at];
    around_[at] = cut.leaf() ? contents[cut.region] : around_[at + 1];
    if (!cut.leaf()) around_[at].join(around_[cut.second]);
  }
}

}  // namespace catena::parts
