#include "catena/bench/knots/known_knots.h"

#include <fmt/format.h>

#include "catena/bench/knots/tight_links.h"
#include "catena/core/input/input.h"

namespace catena::bench {
namespace {

KnownKnot of_link(const std::string& name, TightLink link) {
  return {name, published_knot(name), std::move(link.centres), link.blur};
}

/// A torus knot (p, p + 1) whose windings touch. Only the polygon as it is stored is spoken of: no blur.
KnownKnot of_torus(unsigned p, std::uint32_t n, const std::string& name) {
  const std::string scene = fmt::format("tight_knot:p={},margin=0,n={}", p, n);
  return {scene, published_knot(name), open_input(scene).animation->frame(0), 0};
}

}  // namespace

std::vector<KnownKnot> carried_knots(std::uint32_t n) {
  n += n % 2;  // half circles of the stadium
  std::vector<KnownKnot> knots;
  knots.push_back(of_link("hopf", hopf_link(n)));
  knots.push_back(of_link("chain-of-three", chain_of_three(n)));
  knots.push_back(of_torus(2, 8 * n, "3_1"));
  knots.push_back(of_torus(3, 8 * n, "knotted"));
  return knots;
}

}  // namespace catena::bench
