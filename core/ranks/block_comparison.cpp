#include "catena/core/ranks/block_comparison.h"

#include <algorithm>
#include <bit>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/hierarchy/box_around.h"
#include "catena/core/strategy/registry.h"

namespace catena::ranks {

BlockComparison::BlockComparison(const HeldPart& part, const Border& border, std::uint32_t meetings,
                                 std::vector<Counted>& counted, KeptPairs& kept)
    : part_(part),
      border_(border),
      meetings_(meetings),
      counted_(counted),
      kept_(kept),
      own_count_(border.blocks().size() * Block::most, 0) {}

std::uint64_t BlockComparison::compare() {
  if (far_.blocks() == 0) return 0;
  far_count_.assign(far_.spheres().size(), 0);
  touches_.assign(far_.blocks(), 0);
  // No more is spent on one after the other than a search of all would take, so that both together take no
  // more than twice what the better one does.
  const std::uint64_t most = meetings_ * (std::uint64_t{far_.blocks()} + border_.blocks().size());
  constexpr std::uint64_t at_once = 1 << 16;  // meetings are kept no longer than a cache keeps them
  std::uint32_t block = 0;
  for (std::uint64_t met = 0; block < far_.blocks() && met < most;) {
    near_.clear();
    met += meet_border(border_, far_, std::min(at_once, most - met), block, near_);
    for (const Meeting& meeting : near_) decide(meeting);
  }
  if (block < far_.blocks()) search_from(block);
  count_found();
  far_.clear();
  return static_cast<std::uint64_t>(std::ranges::count(touches_, 1));
}

void BlockComparison::decide(const Meeting& meeting) {
  const auto for_each = [](std::uint64_t bits, const auto& visit) {
    for (; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
      visit(bit / Block::most, bit % Block::most);
    }
  };
  const std::uint32_t begin = far_.begin(meeting.far_block);
  const Slot first = Slot{meeting.own_block} * Block::most;
  std::uint64_t touch = meeting.touch;
  for_each(meeting.may_touch, [&](std::uint32_t k, std::uint32_t f) {
    if (Robust::overlap(border_.eight(meeting.own_block)[k], far_.spheres()[begin + f]))
      touch |= std::uint64_t{1} << (Block::most * k + f);
  });
  if (touch == 0) return;
  touches_[meeting.far_block] = 1;
  const SphereId id = border_.id(meeting.own_block), far_id = far_.id(begin);
  for_each(touch, [&](std::uint32_t k, std::uint32_t f) { count(first + k, id + k, begin + f, far_id + f); });
}

/// Two that overlap, by their numbers in the whole chain, too; unless they are neighbours.
void BlockComparison::count(Slot own, SphereId id, std::uint32_t far, SphereId far_id) {
  if (part_.may_be_neighbours(id, far_id) && are_neighbours(own, far)) return;
  ++own_count_[own], ++far_count_[far];
  kept_.add(id, far_id);
}

/// What HeldPart::place tells of a sphere anywhere in the part, the border has at hand.
bool BlockComparison::are_neighbours(Slot own, std::uint32_t far) const {
  const auto b = static_cast<std::uint32_t>(own / Block::most),
             k = static_cast<std::uint32_t>(own % Block::most);
  const Block& block = border_.blocks()[b];
  const std::span<const double> arcs = part_.arcs(block);
  return part_.neighbours(
      {border_.id(b) + k, part_.piece(block).strand, arcs.empty() ? 0 : arcs[k], border_.eight(b)[k].radius},
      far_.place(far));
}

/// All blocks that came from this one on. The border's are searched among some at a time, so that this takes
/// no more memory than what came, and their number stays one of a chain.
void BlockComparison::search_from(std::uint32_t far_block) {
  const std::vector<std::uint32_t> own = own_blocks_for(far_block);
  const std::size_t far = far_.spheres().size() - far_.begin(far_block);
  constexpr std::size_t fewest = std::size_t{1} << 19;
  const std::size_t at_once = std::max(fewest, far / Block::most);
  for (std::size_t done = 0; done < own.size(); done += at_once)
    search(std::span(own).subspan(done, std::min(at_once, own.size() - done)), far_.begin(far_block));
}

/// Those that may be near any of them.
std::vector<std::uint32_t> BlockComparison::own_blocks_for(std::uint32_t far_block) const {
  std::uint32_t compared = far_.mark(far_block);
  for (std::uint32_t f = far_block; f < far_.blocks(); ++f) compared &= far_.mark(f);
  const Box around = box_around(std::span(far_.spheres()).subspan(far_.begin(far_block)));
  std::vector<std::uint32_t> own;
  border_.boxes().for_each_meeting(around, [&](std::uint32_t b) {
    if (is_compared(b, compared)) own.push_back(b);
  });
  return own;
}

void BlockComparison::search(std::span<const std::uint32_t> own_blocks, std::uint32_t first_far) {
  std::vector<Slot> slots;
  std::vector<Sphere> spheres;
  slots.reserve(own_blocks.size() * Block::most);
  spheres.reserve(own_blocks.size() * Block::most + far_.spheres().size() - first_far);
  for (const std::uint32_t b : own_blocks)
    for (std::uint32_t k = 0; k < border_.blocks()[b].size; ++k) {
      slots.push_back(Slot{b} * Block::most + k);
      spheres.push_back(border_.spheres(b)[k]);
    }
  const auto own = static_cast<std::uint32_t>(slots.size());
  spheres.insert(spheres.end(), far_.spheres().begin() + first_far, far_.spheres().end());
  // As one open strand, whose search is the quickest. It passes over spheres that follow one another: two of
  // this rank, two of others, and the last of the one with the first of the other.
  const Chain chain(std::move(spheres), {}, Exclusion::index(1));
  if (!search_) search_ = StrategyRegistry::instance().make("Hybrid");
  search_->build(chain);
  for_each_pair(*search_, chain, {0, own}, [&](const Pair& pair) {
    if (pair.j >= own) overlap(slots[pair.i], first_far + (pair.j - own));
  });
  if (Robust::overlap(chain[own - 1], chain[own])) overlap(slots.back(), first_far);
}

void BlockComparison::overlap(Slot own, std::uint32_t far) {
  const auto b = static_cast<std::uint32_t>(own / Block::most);
  const std::uint32_t far_block = far_.block_of(far);
  if (!is_compared(b, far_.mark(far_block))) return;  // the other rank's
  touches_[far_block] = 1;
  count(own, border_.id(b) + own % Block::most, far, far_.id(far));
}

void BlockComparison::count_found() {
  for (Slot own = 0; own < own_count_.size(); ++own)
    if (own_count_[own] > 0) {
      counted_.push_back(
          {border_.id(static_cast<std::uint32_t>(own / Block::most)) + own % Block::most, own_count_[own]});
      own_count_[own] = 0;
    }
  for (std::uint32_t far = 0; far < far_count_.size(); ++far)
    if (far_count_[far] > 0) counted_.push_back({far_.id(far), far_count_[far]});
}

}  // namespace catena::ranks
