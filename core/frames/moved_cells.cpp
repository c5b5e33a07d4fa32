#include "catena/core/frames/moved_cells.h"

#include <cmath>
#include <limits>

#include "catena/core/frames/frame_kernels.h"

namespace catena {

template <class Visit>
void MovedCells::for_each_cell(const Box& box, const Visit& visit) const {
  std::array<std::uint32_t, 3> first, last;
  for (int axis = 0; axis < 3; ++axis)
    first[axis] = along(axis, box.low[axis]), last[axis] = along(axis, box.high[axis]);
  for (std::uint32_t z = first[2]; z <= last[2]; ++z)
    for (std::uint32_t y = first[1]; y <= last[1]; ++y)
      for (std::uint32_t x = first[0]; x <= last[0]; ++x) visit(z * step_[2] + y * step_[1] + x);
}

/// The two radii, rounded up, of which the other is the greatest at most.
float MovedCells::reach(const Sphere& s, float greatest_radius) const {
  return std::nextafter(s.radius + greatest_radius, std::numeric_limits<float>::infinity());
}

bool MovedCells::lay_out(const ChainView& chain, std::span<const std::uint32_t> moved) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  around_ = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  boxes_.clear();
  for (const std::uint32_t i : moved) {
    const Sphere& s = chain.spheres[i];
    boxes_.push_back(Box::around({s.x, s.y, s.z, reach(s, chain.extent.greatest_radius)}));
    around_.join(boxes_.back());
  }
  // As wide as two of the widest spheres at least: a box then lies in a few cells.
  for (int axis = 0; axis < 3; ++axis) {
    const float side = around_.high[axis] - around_.low[axis];
    if (!std::isfinite(side)) return false;
    const float cells = std::min<float>(most_along, side / (2 * chain.extent.greatest_radius));
    scale_[axis] = side > 0 && cells >= 1 ? cells / side : 0;
    if (!std::isfinite(scale_[axis])) return false;
    last_[axis] = scale_[axis] > 0 ? std::floor(std::min<float>(cells, most_along - 1)) : 0;
  }
  step_[0] = 1;
  for (int axis = 0; axis < 2; ++axis)
    step_[axis + 1] = step_[axis] * (static_cast<std::uint32_t>(last_[axis]) + 1);
  const std::size_t cells = step_[2] * (static_cast<std::size_t>(last_[2]) + 1);
  begin_.assign(cells + 2, 0);
  filled_.assign(cells / 32 + 1, 0);
  std::size_t entries = 0;
  const std::size_t most = 64 * boxes_.size() + 4096;
  for (const Box& box : boxes_) {
    for_each_cell(box, [&](std::uint32_t cell) {
      ++begin_[cell + 2], ++entries;
      filled_[cell / 32] |= 1u << (cell % 32);
    });
    if (entries > most) return false;
  }
  for (std::size_t k = 2; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  entries_.resize(entries);
  spheres_.resize(entries + 7);
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    for_each_cell(boxes_[k], [&](std::uint32_t cell) {
      const std::uint32_t entry = begin_[cell + 1]++;
      entries_[entry] = moved[k];
      spheres_[entry] = chain.spheres[moved[k]];
    });
  is_few_.assign(chain.size / 32 + 1, 0);
  for (const std::uint32_t i : moved) is_few_[i / 32] |= 1u << (i % 32);
  return true;
}

CellsOfFew MovedCells::view() const {
  return {around_,       scale_,          last_,           step_,         filled_.data(),
          begin_.data(), entries_.data(), spheres_.data(), is_few_.data()};
}

void MovedCells::search(const ChainView& chain, std::vector<Pair>& pairs, std::uint64_t most) const {
  search_cells(chain, view(), most, pairs);
}

}  // namespace catena
