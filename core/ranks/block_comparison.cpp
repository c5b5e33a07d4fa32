#include "catena/core/ranks/block_comparison.h"

#include <algorithm>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/hierarchy/box_around.h"
#include "catena/core/strategy/registry.h"

namespace catena::ranks {

BlockComparison::BlockComparison(const HeldPart& part, const Border& border, std::vector<Counted>& counted,
                                 KeptPairs& kept)
    : part_(part), border_(border), counted_(counted), kept_(kept), expected_(border.blocks().size(), 0) {}

bool BlockComparison::expect(const Box& box, std::uint32_t first) {
  bool meets = false;
  border_.boxes().for_each_meeting(box, [&](std::uint32_t b) {
    if (b < first || (meets && expected_[b] != 0)) return;
    if (!any_meets(part_.spheres(border_.blocks()[b]), box)) return;
    meets = true;
    if (expected_[b] == 0) expected_[b] = 1, near_.push_back(b);
  });
  return meets;
}

std::uint64_t BlockComparison::compare() {
  if (far_.blocks() == 0) return 0;
  gather_own();
  const auto own = static_cast<std::uint32_t>(own_.size());
  std::vector<Sphere> spheres;
  spheres.reserve(own_.size() + far_.spheres().size());
  for (const Own& own_sphere : own_) spheres.push_back(part_.chain()[own_sphere.sphere]);
  spheres.insert(spheres.end(), far_.spheres().begin(), far_.spheres().end());
  collisions_.assign(spheres.size(), 0);
  touches_.assign(far_.blocks(), 0);
  // As one open strand, whose search is the quickest. It passes over spheres that follow one another: two of
  // this rank, two of others, and the last of the one with the first of the other.
  const Chain chain(std::move(spheres), {}, Exclusion::index(1));
  if (!search_) search_ = StrategyRegistry::instance().make("Hybrid");
  search_->build(chain);
  for_each_pair(*search_, chain, {0, own}, [&](const Pair& pair) {
    if (pair.j >= own) visit(pair.i, pair.j - own);
  });
  if (Robust::overlap(chain[own - 1], chain[own])) visit(own - 1, 0);
  count_found();
  far_.clear();
  return static_cast<std::uint64_t>(std::ranges::count(touches_, 1));
}

void BlockComparison::gather_own() {
  std::ranges::sort(near_);
  own_.clear();
  for (const std::uint32_t b : near_) {
    const Block& block = border_.blocks()[b];
    const SphereId first = part_.id(block);
    for (std::uint32_t k = 0; k < block.size; ++k) own_.push_back({first + k, block.begin + k, b});
    expected_[b] = 0;
  }
  near_.clear();
}

void BlockComparison::visit(std::uint32_t own, std::uint32_t far) {
  const auto [id, sphere, block] = own_[own];
  const std::uint32_t far_block = far_.block_of(far);
  if (block < far_.mark(far_block)) return;  // the other rank's
  touches_[far_block] = 1;
  const SphereId far_id = far_.id(far);
  if (part_.may_be_neighbours(id, far_id) && part_.neighbours(part_.place(sphere), far_.place(far))) return;
  ++collisions_[own], ++collisions_[own_.size() + far];
  kept_.add(id, far_id);
}

void BlockComparison::count_found() {
  for (std::size_t k = 0; k < own_.size(); ++k)
    if (collisions_[k] > 0) counted_.push_back({own_[k].id, collisions_[k]});
  for (std::uint32_t k = 0; k < far_.spheres().size(); ++k)
    if (const std::uint64_t found = collisions_[own_.size() + k]; found > 0)
      counted_.push_back({far_.id(k), found});
}

}  // namespace catena::ranks
