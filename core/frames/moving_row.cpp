#include "catena/core/frames/moving_row.h"

#include <algorithm>

#include "catena/core/frames/frame_kernels.h"

namespace catena {

void MovingRow::hold(std::span<const Sphere> spheres) {
  size_ = static_cast<std::uint32_t>(spheres.size());
  // Half as much on either side for frames that are shifted, in whole runs.
  begin_ = size_ / 2 / run * run;
  const std::size_t runs = (std::size_t{2} * begin_ + size_ + run - 1) / run;
  row_.resize(runs * run);
  std::ranges::copy(spheres, row_.begin() + begin_);
  is_changed_.assign(runs, 0);
  changed_.clear();
  changed_.reserve(runs);
  tree_stands_ = false;
}

void MovingRow::change(std::uint32_t first_place, std::uint32_t end_place) {
  for (std::uint32_t r = first_place / run; r * run < end_place; ++r)
    if (!is_changed_[r]) is_changed_[r] = 1, changed_.push_back(r);
}

void MovingRow::move(std::span<const Sphere> now, std::span<const SphereRange> ranges) {
  for (const SphereRange& range : ranges) {
    std::copy(now.begin() + range.begin, now.begin() + range.end, row_.begin() + begin_ + range.begin);
    change(begin_ + range.begin, begin_ + range.end);
  }
  std::ranges::sort(changed_);
}

void MovingRow::shift(std::span<const Sphere> now, std::int64_t s) {
  const std::int64_t begin = begin_ + s;
  if (begin < 0 || begin + size_ > static_cast<std::int64_t>(row_.size())) {
    hold(now);  // back to the middle
    const auto middle = static_cast<std::int64_t>(begin_);
    s > 0 ? change(static_cast<std::uint32_t>(middle + size_ - s), begin_ + size_)
          : change(begin_, static_cast<std::uint32_t>(middle - s));
    return;
  }
  const std::uint32_t old_begin = begin_, old_end = begin_ + size_;
  begin_ = static_cast<std::uint32_t>(begin);
  const std::uint32_t end = begin_ + size_;
  const SphereRange fresh = s > 0 ? SphereRange{old_end, end} : SphereRange{begin_, old_begin};
  const SphereRange gone = s > 0 ? SphereRange{old_begin, begin_} : SphereRange{end, old_end};
  std::copy(now.begin() + (fresh.begin - begin_), now.begin() + (fresh.end - begin_),
            row_.begin() + fresh.begin);
  change(fresh.begin, fresh.end);
  if (tree_stands_) tree_.refresh(view(), gone.begin / run, (gone.end - 1) / run + 1);
}

void MovingRow::find_changed(std::span<const Pair> pairs, std::vector<std::uint32_t>& places) const {
  find_pairs_of_runs(pairs, view(), places);
}

SphereRange MovingRow::spheres_of(std::uint32_t of) const {
  const std::uint32_t first = std::max(of * run, begin_), end = std::min((of + 1) * run, begin_ + size_);
  return first < end ? SphereRange{first - begin_, end - begin_} : SphereRange{0, 0};
}

bool MovingRow::search_cells(const ChainView& chain, std::vector<Pair>& found, std::uint64_t most) {
  moved_.clear();
  for (const std::uint32_t r : changed_)
    for (std::uint32_t i = spheres_of(r).begin; i < spheres_of(r).end; ++i) moved_.push_back(i);
  if (!cells_->lay_out(chain, moved_)) return false;
  cells_->search(chain, found, most);
  return true;
}

/// The tree over the row as it is now.
void MovingRow::stand_tree() {
  if (!tree_stands_) {
    tree_.clear(static_cast<std::uint32_t>(row_.size()));
    tree_.refresh(view(), begin_ / run, (begin_ + size_ + run - 1) / run);
    tree_stands_ = true;
    return;
  }
  // Neighbours together, so that what is above them is made once.
  for (std::size_t k = 0; k < changed_.size();) {
    std::size_t end = k + 1;
    while (end < changed_.size() && changed_[end] == changed_[end - 1] + 1) ++end;
    tree_.refresh(view(), changed_[k], changed_[end - 1] + 1);
    k = end;
  }
}

bool MovingRow::search(const ChainView& chain, std::vector<Pair>& found, bool by_cells, std::uint64_t most) {
  found.clear();
  by_cells = by_cells && search_cells(chain, found, most);
  if (by_cells) {
    tree_stands_ = false;  // it is of what was there before
  } else {
    stand_tree();
    tree_.search(chain, view(), most, found);
  }
  for (const std::uint32_t r : changed_) is_changed_[r] = 0;
  changed_.clear();
  return by_cells;
}

}  // namespace catena
