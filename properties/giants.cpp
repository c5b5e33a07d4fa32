#include "catena/properties/giants.h"

namespace catena::properties {
namespace {

constexpr std::uint32_t past = 1u << 16;

/// Far from its neighbours each, on a line; of the last thousand some lie on others, near and far along it.
Chain line() {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < past + 1000; ++i) spheres.push_back({3 * static_cast<float>(i), 0, 0, 1});
  const auto lay_on = [&](std::uint32_t i, std::uint32_t j) { spheres[i] = spheres[j], spheres[i].y = 1; };
  for (std::uint32_t k = 0; k < 8; ++k) {
    lay_on(past + 11 + 100 * k, 7 + 9 * k);
    lay_on(past + 13 + 100 * k, past - 5 - 3 * k);
    lay_on(past + 17 + 100 * k, past + 40 + 100 * k);
  }
  return Chain(std::move(spheres));
}

/// As many strands as spheres, each of which meets the next; joints make neighbours of some.
Chain strands() {
  const std::uint32_t n = past + 100;
  std::vector<Sphere> spheres;
  Strands strands;
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back({1.75f * static_cast<float>(i), 0, 0, 1});
    strands.first.push_back(i);
  }
  strands.first.push_back(n);
  Exclusion exclusion;
  for (std::uint32_t i = past - 50; i + 1 < n; i += 3) exclusion.extra_pairs.push_back({i, i + 1});
  return Chain(std::move(spheres), std::move(strands), std::move(exclusion));
}

}  // namespace

const std::vector<Case>& giants() {
  static const std::vector<Case> all = [] {
    std::vector<Case> cases;
    cases.push_back(Case::of(line()));
    cases.push_back(Case::of(strands()));
    return cases;
  }();
  return all;
}

}  // namespace catena::properties
