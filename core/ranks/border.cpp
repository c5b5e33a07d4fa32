#include "catena/core/ranks/border.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "catena/core/executor/team.h"
#include "catena/core/hierarchy/box_around.h"
#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/prefetch.h"
#include "catena/core/space_tree/key_sort.h"

namespace catena::ranks {
namespace {

struct Blocks {
  std::vector<Block> block;
  std::vector<Box> box;
  std::vector<Sphere> middle;
};

/// Those of the part that may touch another rank, by tops around all that each holds.
Blocks blocks_near_others(Communicator& ranks, const HeldPart& part) {
  const LargeVector<Box> stretches = boxes_of_stretches(part.pieces(), part.chain().spheres());
  const ForeignTops foreign(Tops::of_all(ranks, stretches), ranks.rank());
  std::vector<std::uint8_t> near;
  near.reserve(stretches.size());
  for (const Box& box : stretches) near.push_back(foreign.meet(box));
  Blocks found;
  const auto most = static_cast<std::size_t>(std::ranges::count(near, 1)) * Stretches::most;
  found.block.reserve(most), found.box.reserve(most), found.middle.reserve(most);
  Stretches ends(part.pieces());
  std::size_t at = 0;
  for_each_block(part.pieces(), [&](const Block& block) {
    const bool is_near = near[at] != 0;
    at += ends.end_with(block);
    if (!is_near) return;
    const Box box = box_around(part.spheres(block));
    if (!foreign.meet(box)) return;
    found.block.push_back(block), found.box.push_back(box);
    found.middle.push_back(middle_of(part.chain().spheres(), block));
  });
  return found;
}

/// The ranks that each of some blocks may touch.
struct NearRanks {
  std::vector<std::uint32_t> block;  ///< that may touch one
  std::vector<std::size_t> first;    ///< in `rank`, of each of these; and the end
  std::vector<unsigned> rank;        ///< ascending for each block
};

NearRanks ranks_near(const Blocks& blocks, const ForeignTops& tops) {
  NearRanks near;
  for (std::uint32_t k = 0; tops.any() && k < blocks.box.size(); ++k) {
    const std::size_t before = near.rank.size();
    tops.for_each_rank(blocks.box[k], [&](unsigned rank) { near.rank.push_back(rank); });
    if (near.rank.size() > before) near.block.push_back(k), near.first.push_back(before);
  }
  near.first.push_back(near.rank.size());
  return near;
}

/// Places among these blocks, in the order of Morton codes.
std::vector<std::uint64_t> order_in_space(const Blocks& blocks, std::span<const std::uint32_t> these) {
  CentreCorners corners;
  for (const std::uint32_t k : these) corners.take(blocks.middle[k]);
  const MortonGrid grid(corners);
  std::vector<std::uint64_t> keys;  // the upper half of a code, and the place
  keys.reserve(these.size());
  for (std::uint64_t at = 0; at < these.size(); ++at) {
    const std::uint64_t code = grid.code(blocks.middle[these[at]]);
    keys.push_back(code >> (3 * MortonGrid::bits - 32) << 32 | at);
  }
  KeySort()(keys, Team());
  return keys;
}

/// The bit of their numbers that parts blocks of a border of this size most evenly: in stripes as long as may
/// be, of which a part is told and the other kept, so that few blocks touch both.
std::uint32_t stripe_bit(std::span<const std::uint32_t> blocks, std::uint32_t size) {
  constexpr std::uint32_t few = 8, many = 64;  // stripes of all
  constexpr double even = 1. / 16;
  std::uint32_t best = 1;
  double least = 1;
  for (std::uint32_t bit = std::bit_floor(size / few); bit > size / (2 * many) && least > even; bit /= 2) {
    const auto with = std::ranges::count_if(blocks, [&](std::uint32_t b) { return is_compared(b, bit); });
    const double uneven = std::abs(static_cast<double>(with) / static_cast<double>(blocks.size()) - .5);
    if (uneven < least) best = bit, least = uneven;
  }
  return best;
}

}  // namespace

Border::Border(Communicator& ranks, const HeldPart& part) : partners_(ranks.size()) {
  const Blocks blocks = blocks_near_others(ranks, part);
  // What touches a block of this rank is near this rank, too: tops around such blocks alone are finer.
  const ForeignTops foreign(Tops::of_all(ranks, blocks.box), ranks.rank());
  const NearRanks near = ranks_near(blocks, foreign);
  const auto size = static_cast<std::uint32_t>(near.block.size());
  std::size_t spheres = 0;
  for (const std::uint32_t k : near.block) spheres += blocks.block[k].size;
  blocks_.reserve(size), ids_.reserve(size), begin_.reserve(size);
  spheres_.reserve(spheres + Block::most);
  boxes_.clear(size);
  const std::vector<std::uint64_t> keys = order_in_space(blocks, near.block);
  const auto place = [&](std::size_t b) { return static_cast<std::uint32_t>(keys[b]); };
  const auto fetch = [&](std::size_t b) {  // as blocks that are near in space lie anywhere in the part
    if (b >= size) return;
    const Block& block = blocks.block[near.block[place(b)]];
    const std::span<const Sphere> soon = part.spheres(block);
    for (const std::size_t k : {std::size_t{0}, soon.size() / 2, soon.size() - 1}) prefetch(&soon[k]);
    prefetch(&part.piece(block));
  };
  for (std::uint32_t b = 0; b < size; ++b) {
    constexpr std::size_t ahead = 8;
    fetch(b + ahead);
    const std::uint32_t at = place(b), k = near.block[at];
    const Block& block = blocks_.emplace_back(blocks.block[k]);
    const std::span<const Sphere> own = part.spheres(block);
    begin_.push_back(static_cast<std::uint32_t>(spheres_.size()));
    spheres_.insert(spheres_.end(), own.begin(), own.end());
    ids_.push_back(part.id(block));
    boxes_.set(b, blocks.box[k]);
    for (std::size_t n = near.first[at]; n < near.first[at + 1]; ++n)
      partners_[near.rank[n]].told.push_back(b);
  }
  spheres_.insert(spheres_.end(), Block::most - 1, Sphere{});
  boxes_.refresh(0, size);
  for (unsigned rank = 0; rank < ranks.size(); ++rank) {
    Partner& partner = partners_[rank];
    partner.near = partner.told.size();
    if (rank > ranks.rank() || partner.near == 0) continue;
    partner.compared = stripe_bit(partner.told, size);
    std::erase_if(partner.told, [&](std::uint32_t b) { return is_compared(b, partner.compared); });
  }
}

}  // namespace catena::ranks
