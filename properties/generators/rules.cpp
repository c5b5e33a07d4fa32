#include "catena/properties/generators/rules.h"

#include <algorithm>

#include "catena/properties/generators/family.h"
#include "catena/properties/generators/shapes.h"

namespace catena::properties {

void cut_into_strands(Draft& draft, Dice& dice) {
  const std::uint32_t n = draft.size(), strands = 1 + dice.below(5);
  draft.strands = {{0, n}, {}};
  for (std::uint32_t s = 1; s < strands; ++s) draft.strands.first.push_back(dice.below(n + 1));
  std::ranges::sort(draft.strands.first);
  for (std::uint32_t s = 0; s < strands; ++s) draft.strands.closed.push_back(dice.one_in(3));
}

void close_the_strand(Draft& draft, Dice&) { draft.strands = Strands::one_closed(draft.size()); }

void widen_the_window(Draft& draft, Dice& dice) {
  auto extra = std::move(draft.exclusion.extra_pairs);
  const std::uint32_t n = draft.size();
  const std::uint32_t half = std::max(2u, n / 2);
  draft.exclusion =
      Exclusion::index(dice.pick({2u, 3u, 2 + dice.below(6), half - 1, half, half + 1, n, ~0u}));
  draft.exclusion.window = std::max(2u, draft.exclusion.window);
  draft.exclusion.extra_pairs = std::move(extra);
}

void measure_by_arc(Draft& draft, Dice& dice) {
  auto extra = std::move(draft.exclusion.extra_pairs);
  draft.exclusion =
      Exclusion::arc(dice.pick({1.5707963267948966, 1.0, 2.0, 0.1 + dice.unit() * 4, 1e-300, 1e300}));
  draft.exclusion.extra_pairs = std::move(extra);
}

void add_joints(Draft& draft, Dice& dice) {
  const std::uint32_t n = draft.size();
  if (n < 2) return;
  for (std::uint32_t k = 1 + dice.below(n); k > 0; --k) {
    const std::uint32_t i = dice.below(n), j = (i + 1 + dice.below(n - 1)) % n;
    draft.exclusion.extra_pairs.push_back({i, j});
  }
}

void change_rule(Draft& draft, Dice& dice) {
  if (dice.one_in(2)) dice.one_in(2) ? cut_into_strands(draft, dice) : close_the_strand(draft, dice);
  if (dice.one_in(2)) dice.one_in(2) ? widen_the_window(draft, dice) : measure_by_arc(draft, dice);
  if (dice.one_in(2)) add_joints(draft, dice);
}

namespace {

template <void (*change)(Draft&, Dice&)>
Draft changed_tangle(Dice& dice, std::uint32_t size) {
  Draft draft{
      dice.one_in(3) ? integer_walk(dice, 1 + dice.below(size)) : tangle(dice, 1 + dice.below(size)), {}, {}};
  change(draft, dice);
  return draft;
}

const RegisterFamily strands{"strands", "1 to 5 strands, empty and single ones among them",
                             changed_tangle<cut_into_strands>, true},
    closed{"closed", "one closed strand", changed_tangle<close_the_strand>, true},
    windows{"windows", "index windows above 1, up to beyond n", changed_tangle<widen_the_window>, true},
    arcs{"arcs", "arc-length windows", changed_tangle<measure_by_arc>, true},
    joints{"joints", "extra pairs", changed_tangle<add_joints>, true},
    rules{"rules", "strands, windows and extra pairs together", changed_tangle<change_rule>, true};

}  // namespace
}  // namespace catena::properties
