#include "catena/core/frames/moving_row.h"

#include <algorithm>
#include <array>

#include "catena/core/arithmetic/robust.h"

namespace catena {

void MovingRow::hold(std::span<const Sphere> spheres) {
  size_ = static_cast<std::uint32_t>(spheres.size());
  // Half as much on either side for frames that are shifted, in whole runs.
  begin_ = size_ / 2 / run * run;
  row_.resize(std::size_t{2} * begin_ + size_);
  std::ranges::copy(spheres, row_.begin() + begin_);
  is_changed_.assign(row_.size() / run + 1, 0);
  changed_.clear();
  changed_.reserve(is_changed_.size());
  tree_stands_ = false;
  shifted_by_ = 0;
}

void MovingRow::change(std::uint32_t first_place, std::uint32_t end_place) {
  for (std::uint32_t r = first_place / run; r * run < end_place; ++r)
    if (!is_changed_[r]) is_changed_[r] = 1, changed_.push_back(r);
}

void MovingRow::refresh(std::uint32_t first_run, std::uint32_t end_run) {
  tree_.refresh(row_.data(), begin_, begin_ + size_, first_run, end_run);
}

void MovingRow::move(std::span<const Sphere> now, std::span<const SphereRange> ranges) {
  shifted_by_ = 0;
  for (const SphereRange& range : ranges) {
    std::copy(now.begin() + range.begin, now.begin() + range.end, row_.begin() + begin_ + range.begin);
    change(begin_ + range.begin, begin_ + range.end);
  }
}

void MovingRow::shift(std::span<const Sphere> now, std::int64_t s) {
  const std::int64_t begin = begin_ + s;
  if (begin < 0 || begin + size_ > static_cast<std::int64_t>(row_.size())) {
    hold(now);  // back to the middle
    shifted_by_ = s;
    const auto middle = static_cast<std::int64_t>(begin_);
    s > 0 ? change(static_cast<std::uint32_t>(middle + size_ - s), begin_ + size_)
          : change(begin_, static_cast<std::uint32_t>(middle - s));
    return;
  }
  const std::uint32_t old_begin = begin_, old_end = begin_ + size_;
  begin_ = static_cast<std::uint32_t>(begin);
  shifted_by_ = s;
  const std::uint32_t end = begin_ + size_;
  const SphereRange fresh = s > 0 ? SphereRange{old_end, end} : SphereRange{begin_, old_begin};
  const SphereRange gone = s > 0 ? SphereRange{old_begin, begin_} : SphereRange{end, old_end};
  std::copy(now.begin() + (fresh.begin - begin_), now.begin() + (fresh.end - begin_),
            row_.begin() + fresh.begin);
  change(fresh.begin, fresh.end);
  if (tree_stands_) refresh(gone.begin / run, (gone.end - 1) / run + 1);
}

SphereRange MovingRow::spheres_of(std::uint32_t of) const {
  const std::uint32_t first = std::max(of * run, begin_), end = std::min((of + 1) * run, begin_ + size_);
  return first < end ? SphereRange{first - begin_, end - begin_} : SphereRange{0, 0};
}

void MovingRow::compare_runs(const ChainView& chain, std::uint32_t of, std::uint32_t other,
                             std::vector<Pair>& pairs) const {
  const SphereRange own = spheres_of(of), theirs = spheres_of(other);
  if (own.size() == 0 || theirs.size() == 0) return;
  // Eight at a time, a coordinate after the other, as vectors take them; the last one stands for what is not
  // there, and is not heeded.
  std::array<float, run> x, y, z, r;
  for (std::uint32_t k = 0; k < run; ++k) {
    const Sphere& s = chain.spheres[std::min(theirs.begin + k, theirs.end - 1)];
    x[k] = s.x, y[k] = s.y, z[k] = s.z, r[k] = s.radius;
  }
  for (std::uint32_t i = own.begin; i < own.end; ++i) {
    const Sphere a = chain.spheres[i];
    std::array<std::uint32_t, run> near;
    std::uint32_t any = 0;
    for (std::uint32_t k = 0; k < run; ++k) {
      near[k] = std::uint32_t{!Robust::separate(a, {x[k], y[k], z[k], r[k]})};
      any |= near[k];
    }
    if (any == 0) continue;
    for (std::uint32_t j = other == of ? i + 1 : theirs.begin; j < theirs.end; ++j)
      if (near[j - theirs.begin] != 0 && !chain.neighbours(i, j) && Robust::overlap(a, chain.spheres[j]))
        pairs.push_back({std::min(i, j), std::max(i, j)});
  }
}

void MovingRow::search_runs(const ChainView& chain, std::vector<Pair>& pairs) {
  std::ranges::sort(changed_);
  for (std::size_t k = 0, end = 0; k < changed_.size(); k = end) {
    while (end < changed_.size() && changed_[end] / RunTree::together == changed_[k] / RunTree::together)
      ++end;
    tree_.for_each_near(std::span(changed_).subspan(k, end - k), [&](std::uint32_t of, std::uint32_t other) {
      // Two runs that changed are met from both: once is enough.
      if (!(is_changed_[other] && other < of)) compare_runs(chain, of, other, pairs);
    });
  }
}

/// Those of two spheres that are still there, by their new indices.
void MovingRow::renumber(std::vector<Pair>& pairs) const {
  std::size_t left = 0;
  for (const Pair& p : pairs) {
    const std::int64_t i = p.i - shifted_by_, j = p.j - shifted_by_;
    if (i >= 0 && j < static_cast<std::int64_t>(size_))
      pairs[left++] = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)};
  }
  pairs.resize(left);
}

bool MovingRow::search_cells(const ChainView& chain, std::vector<Pair>& pairs) {
  std::ranges::sort(changed_);
  moved_.clear();
  for (const std::uint32_t r : changed_)
    for (std::uint32_t i = spheres_of(r).begin; i < spheres_of(r).end; ++i) moved_.push_back(i);
  if (!cells_.lay_out(chain, moved_)) return false;
  cells_.search(chain, [this](std::uint32_t i) { return is_changed_[(begin_ + i) / run] != 0; }, pairs);
  return true;
}

/// The tree over the row as it is now.
void MovingRow::stand_tree() {
  if (!tree_stands_) {
    tree_.clear(static_cast<std::uint32_t>(row_.size()));
    refresh(begin_ / run, (begin_ + size_ + run - 1) / run);
    tree_stands_ = true;
    return;
  }
  // Neighbours together, so that what is above them is made once.
  for (std::size_t k = 0; k < changed_.size();) {
    std::size_t end = k + 1;
    while (end < changed_.size() && changed_[end] == changed_[end - 1] + 1) ++end;
    refresh(changed_[k], changed_[end - 1] + 1);
    k = end;
  }
}

bool MovingRow::search(const ChainView& chain, std::vector<Pair>& pairs, std::span<std::uint32_t> counts,
                       bool by_cells) {
  if (shifted_by_ != 0) renumber(pairs);
  for (std::size_t k = 0; k < pairs.size();) {
    if (kept(pairs[k])) {
      ++k;
      continue;
    }
    if (!counts.empty()) --counts[pairs[k].i], --counts[pairs[k].j];
    pairs[k] = pairs.back();
    pairs.pop_back();
  }
  const std::size_t kept_pairs = pairs.size();
  by_cells = by_cells && search_cells(chain, pairs);
  if (by_cells) {
    tree_stands_ = false;  // it is of what was there before
  } else {
    stand_tree();
    search_runs(chain, pairs);
  }
  if (!counts.empty())
    for (std::size_t k = kept_pairs; k < pairs.size(); ++k) ++counts[pairs[k].i], ++counts[pairs[k].j];
  for (const std::uint32_t r : changed_) is_changed_[r] = 0;
  changed_.clear();
  return by_cells;
}

}  // namespace catena
