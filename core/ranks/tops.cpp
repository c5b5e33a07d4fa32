#include "catena/core/ranks/tops.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

/// The blocks of a part by the cubes of a grid that their middles are in, in the order of Morton codes; cubes
/// without blocks are left out. They take the place of sorted blocks.
struct Cubes {
  std::vector<std::uint32_t> code;
  std::vector<Box> box;
};

/// Cubes along each axis of a box that encloses all, 2^bits, from first to last along the longest.
class CubeGrid {
 public:
  static constexpr int most_bits = 4;  // no more cubes than a cache holds

  CubeGrid(const Box& all, std::size_t blocks) {
    while (bits_ < most_bits && (std::size_t{1} << 3 * bits_) < blocks) ++bits_;
    double side = 0;
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::max(double{all.low[axis]}, -greatest);
      side = std::max(side, std::min(double{all.high[axis]}, greatest) - low_[axis]);
    }
    if (side > 0) cubes_a_length_ = (1 << bits_) / side;
  }
  std::uint32_t size() const { return 1u << 3 * bits_; }
  std::uint32_t cube(const Box& box) const {
    std::uint32_t cube = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = ((double{box.low[axis]} + box.high[axis]) / 2 - low_[axis]) * cubes_a_length_;
      const double within =
          at > 0 ? std::min(at, double((1 << bits_) - 1)) : 0;  // endless boxes lie anywhere
      cube = cube << bits_ | static_cast<std::uint32_t>(within);
    }
    return cube;
  }
  /// The Morton code of a cube.
  std::uint32_t code(std::uint32_t cube) const {
    std::uint32_t code = 0;
    for (int bit = bits_ - 1; bit >= 0; --bit)
      for (int axis = 2; axis >= 0; --axis) code = code << 1 | (cube >> (axis * bits_ + bit) & 1);
    return code;
  }

 private:
  static constexpr double greatest = std::numeric_limits<float>::max();
  int bits_ = 3;
  double low_[3], cubes_a_length_ = 0;
};

Cubes cubes_of(std::span<const Box> blocks) {
  Box all = Box::nothing();
  for (const Box& box : blocks) all.join(box);
  const CubeGrid grid(all, blocks.size());
  std::vector<Box> cubes(grid.size(), Box::nothing());
  for (const Box& box : blocks) cubes[grid.cube(box)].join(box);
  std::vector<std::uint32_t> cube_of(grid.size());  // [Morton code]
  for (std::uint32_t k = 0; k < grid.size(); ++k) cube_of[grid.code(k)] = k;
  Cubes found;
  for (std::uint32_t code = 0; code < grid.size(); ++code)
    if (const Box& box = cubes[cube_of[code]]; box.low[0] <= box.high[0])
      found.code.push_back(code), found.box.push_back(box);
  return found;
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

/// One box around all, then the tops; nothing for no blocks. The largest is parted, where the highest bit of
/// its cubes' codes changes, until there are `most`.
std::vector<Box> tops_of(const Cubes& cubes, std::size_t most) {
  if (cubes.box.empty()) return {};
  const auto smaller = [](const Range& a, const Range& b) { return a.size < b.size; };
  std::vector<Range> ranges{range_of(cubes, 0, static_cast<std::uint32_t>(cubes.box.size()))}, single;
  std::vector<Box> tops{ranges[0].box};
  while (!ranges.empty() && ranges.size() + single.size() < most) {
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

Tops Tops::of_all(Communicator& ranks, std::span<const Box> boxes) {
  const std::vector<Box> own = tops_of(cubes_of(boxes), most_of(ranks.size()));
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
