#include "catena/core/ranks/tops.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

/// The blocks of a part by the cubes of a grid that their middles are in, in the order of its Morton codes; cubes
/// without blocks are left out. They take the place of sorted blocks.
struct Cubes {
  std::vector<std::uint32_t> code;
  std::vector<Box> box;
};

constexpr Box nowhere() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

/// About as many cubes as there are blocks, and no more than a cache holds.
int bits_an_axis(std::uint64_t blocks) {
  int bits = 3;
  while (bits < 5 && (std::uint64_t{1} << 3 * bits) < blocks) ++bits;
  return bits;
}

Cubes cubes_of(std::span<const Piece> pieces, std::span<const Sphere> spheres, std::uint64_t step) {
  CentreCorners corners;
  for_some_blocks(pieces, step, [&](const Block& block) { corners.take(middle_of(spheres, block)); });
  const MortonGrid grid(corners);
  const int bits = bits_an_axis(blocks_of(pieces) / step);
  std::vector<Box> boxes(std::size_t{1} << 3 * bits, nowhere());
  for_some_blocks(pieces, step, [&](const Block& block) {
    boxes[grid.code(middle_of(spheres, block)) >> 3 * (MortonGrid::bits - bits)].join(
        box_around(spheres.subspan(block.begin, block.size)));
  });
  Cubes cubes;
  for (std::uint32_t k = 0; k < boxes.size(); ++k)
    if (boxes[k].low[0] <= boxes[k].high[0]) cubes.code.push_back(k), cubes.box.push_back(boxes[k]);
  return cubes;
}

/// Consecutive cubes.
struct Range {
  std::uint32_t begin, end;
  Box box;
  double size;
};

Range range_of(const Cubes& cubes, std::uint32_t begin, std::uint32_t end) {
  Box box = cubes.box[begin];
  for (std::uint32_t k = begin + 1; k < end; ++k) box.join(cubes.box[k]);
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) size += double{box.high[axis]} - box.low[axis];
  return {begin, end, box, size};
}

/// Where the second half of a range of several cubes begins.
std::uint32_t middle_of(const Cubes& cubes, const Range& range) {
  const std::uint32_t highest = std::bit_floor(cubes.code[range.begin] ^ cubes.code[range.end - 1]);
  const auto begin = cubes.code.begin();
  const auto second = std::partition_point(begin + range.begin, begin + range.end,
                                           [&](std::uint32_t code) { return (code & highest) == 0; });
  return static_cast<std::uint32_t>(second - begin);
}

/// One box around all, then the tops; nothing for no blocks. The largest is parted, where the highest bit of its cubes'
/// codes changes, until there are as many.
std::vector<Box> tops_of(const Cubes& cubes) {
  if (cubes.box.empty()) return {};
  const auto smaller = [](const Range& a, const Range& b) { return a.size < b.size; };
  std::vector<Range> ranges{range_of(cubes, 0, static_cast<std::uint32_t>(cubes.box.size()))}, single;
  std::vector<Box> tops{ranges[0].box};
  while (!ranges.empty() && ranges.size() + single.size() < Tops::most) {
    std::ranges::pop_heap(ranges, smaller);
    const Range largest = ranges.back();
    ranges.pop_back();
    if (largest.end - largest.begin == 1) {
      single.push_back(largest);
      continue;
    }
    const std::uint32_t middle = middle_of(cubes, largest);
    for (const Range& half : {range_of(cubes, largest.begin, middle), range_of(cubes, middle, largest.end)}) {
      ranges.push_back(half);
      std::ranges::push_heap(ranges, smaller);
    }
  }
  ranges.insert(ranges.end(), single.begin(), single.end());
  std::ranges::sort(ranges, {}, &Range::begin);  // a tree over them is one of space
  for (const Range& range : ranges) tops.push_back(range.box);
  return tops;
}

}  // namespace

Tops Tops::of_all(Communicator& ranks, std::span<const Piece> pieces, std::span<const Sphere> spheres,
                   std::uint64_t step) {
  const std::vector<Box> own = tops_of(cubes_of(pieces, spheres, step));
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

Box Tops::around(unsigned rank) const {
  Box box;
  std::memcpy(&box, (*gathered_)[rank].data(), sizeof box);
  return box;
}

ForeignTops::ForeignTops(const Tops& tops, unsigned own) {
  if (tops.boxes_of(own) == 0) return;
  const Box around = tops.around(own);
  std::vector<Box> boxes;
  for (unsigned rank = 0; rank < tops.ranks(); ++rank) {
    if (rank == own || tops.boxes_of(rank) == 0 || !tops.around(rank).meets(around)) continue;
    for (std::uint32_t k = 0; k < tops.boxes_of(rank); ++k)
      if (const Box box = tops.box(rank, k); box.meets(around)) boxes.push_back(box), rank_.push_back(rank);
  }
  const auto size = static_cast<std::uint32_t>(boxes.size());
  boxes_.clear(size);
  for (std::uint32_t k = 0; k < size; ++k) boxes_.set(k, boxes[k]);
  boxes_.refresh(0, size);
}

}  // namespace catena::ranks
