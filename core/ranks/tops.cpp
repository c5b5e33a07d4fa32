#include "catena/core/ranks/tops.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

/// Consecutive blocks.
struct Range {
  std::uint32_t begin, end;
  Box box;
  double size;
};

Range range_of(const HeldPart& part, std::uint32_t begin, std::uint32_t end) {
  Box box = part.boxes().box(begin);
  for (std::uint32_t b = begin + 1; b < end; ++b) box.join(part.boxes().box(b));
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) size += double{box.high[axis]} - box.low[axis];
  return {begin, end, box, size};
}

/// Where the second half of a range of several blocks begins.
std::uint32_t middle_of(std::span<const std::uint64_t> codes, const Range& range) {
  const std::uint64_t differ = codes[range.begin] ^ codes[range.end - 1];
  if (differ == 0) return range.begin + (range.end - range.begin) / 2;
  const std::uint64_t highest = std::bit_floor(differ);
  const auto second = std::partition_point(codes.begin() + range.begin, codes.begin() + range.end,
                                           [&](std::uint64_t code) { return (code & highest) == 0; });
  return static_cast<std::uint32_t>(second - codes.begin());
}

/// One box around all, then the tops; nothing for no blocks.
std::vector<Box> tops_of(const HeldPart& part) {
  const auto blocks = static_cast<std::uint32_t>(part.blocks().size());
  if (blocks == 0) return {};
  const auto smaller = [](const Range& a, const Range& b) { return a.size < b.size; };
  std::vector<Range> ranges{range_of(part, 0, blocks)}, single;
  std::vector<Box> tops{ranges[0].box};
  while (!ranges.empty() && ranges.size() + single.size() < Tops::most) {
    std::ranges::pop_heap(ranges, smaller);
    const Range largest = ranges.back();
    ranges.pop_back();
    if (largest.end - largest.begin == 1) {
      single.push_back(largest);
      continue;
    }
    const std::uint32_t middle = middle_of(part.codes(), largest);
    for (const Range& half : {range_of(part, largest.begin, middle), range_of(part, middle, largest.end)}) {
      ranges.push_back(half);
      std::ranges::push_heap(ranges, smaller);
    }
  }
  for (const auto* some : {&ranges, &single})
    for (const Range& range : *some) tops.push_back(range.box);
  return tops;
}

}  // namespace

Tops Tops::of_all(Communicator& ranks, const HeldPart& part) {
  const std::vector<Box> own = tops_of(part);
  return Tops(ranks.all_gather(ByteWriter().put_all(std::span<const Box>(own)).take()));
}

std::uint32_t Tops::boxes_of(unsigned rank) const {
  const std::size_t boxes = (*gathered_)[rank].size() / sizeof(Box);
  return boxes == 0 ? 0 : static_cast<std::uint32_t>(boxes - 1);
}

Box Tops::box(unsigned rank, std::uint32_t k) const {
  Box box;
  std::memcpy(&box, (*gathered_)[rank].data() + (k + 1) * sizeof box, sizeof box);
  return box;
}

bool Tops::meets(unsigned rank, const Box& box) const {
  const std::uint32_t boxes = boxes_of(rank);
  if (boxes == 0) return false;
  Box around;
  std::memcpy(&around, (*gathered_)[rank].data(), sizeof around);
  if (!around.meets(box)) return false;
  for (std::uint32_t k = 0; k < boxes; ++k)
    if (this->box(rank, k).meets(box)) return true;
  return false;
}

bool Tops::meet(unsigned a, unsigned b) const {
  for (std::uint32_t k = 0; k < boxes_of(a); ++k)
    if (meets(b, box(a, k))) return true;
  return false;
}

WideBoxTree Tops::tree(unsigned rank) const {
  WideBoxTree tree;
  tree.clear(boxes_of(rank));
  for (std::uint32_t k = 0; k < boxes_of(rank); ++k) tree.set(k, box(rank, k));
  tree.refresh(0, boxes_of(rank));
  return tree;
}

}  // namespace catena::ranks
