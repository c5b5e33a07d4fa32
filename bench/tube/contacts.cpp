#include "catena/bench/tube/contacts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace catena::bench {
namespace {

constexpr double grid_in_radii = 0.125;
constexpr double near_in_radii = 2.25;  // room for covering spheres: those of spacing 1 are 1.12 radii

using Cell = std::pair<std::int32_t, std::int32_t>;

/// The least value of f near `middle`, within `reach`, by thirds.
template <class F>
double least_at(double middle, double reach, const F& f) {
  double low = middle - reach, high = middle + reach;
  for (int k = 0; k < 45; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (f(a) < f(b))
      high = b;
    else
      low = a;
  }
  return (low + high) / 2;
}

class Search {
 public:
  explicit Search(const Tube& tube)
      : tube_(tube),
        steps_(static_cast<std::int32_t>(std::ceil(tube.length / (grid_in_radii * tube.radius)))) {
    step_ = tube.length / steps_;
    for (std::int32_t i = 0; i < steps_ + !tube.closed; ++i) points_.push_back(tube.position(i * step_));
  }

  std::vector<Approach> run() {
    find_cells();
    std::vector<Approach> all;
    while (!cells_.empty()) {
      Approach approach = refined(take_region());
      // A bend comes near itself only along the tube. It never touches: by Schur's theorem two places pi r
      // apart along a tube whose curvature is below 1/r are at least 2r apart.
      if (!tube_.neighbours(approach.s, approach.t)) all.push_back(std::move(approach));
    }
    return all;
  }

 private:
  /// Grid cells near enough, by brute force but for the stretch that a pair too far apart allows to skip.
  void find_cells() {
    const double limit = near_in_radii * tube_.radius + step_;
    const auto size = static_cast<std::int32_t>(points_.size());
    for (std::int32_t i = 0; i < size; ++i)
      for (std::int32_t j = i + 1; j < size;) {
        const double d = length(points_[static_cast<std::size_t>(i)] - points_[static_cast<std::size_t>(j)]);
        if (d <= limit && !tube_.neighbours(i * step_, j * step_)) cells_.emplace(Cell{i, j}, d);
        // The centre line cannot come nearer faster than it is travelled.
        j += d > limit ? std::max(1, static_cast<std::int32_t>((d - limit) / step_)) : 1;
      }
  }

  /// One connected region, taken out of the cells.
  std::map<Cell, double> take_region() {
    std::map<Cell, double> region;
    std::vector<Cell> open{cells_.begin()->first};
    while (!open.empty()) {
      const Cell c = open.back();
      open.pop_back();
      const auto found = cells_.find(c);
      if (found == cells_.end()) continue;
      region.insert(*found);
      cells_.erase(found);
      for (std::int32_t di = -1; di <= 1; ++di)
        for (std::int32_t dj = -1; dj <= 1; ++dj) open.push_back(wrapped({c.first + di, c.second + dj}));
    }
    return region;
  }

  Cell wrapped(Cell c) const {
    if (!tube_.closed) return c;
    c = {(c.first + steps_) % steps_, (c.second + steps_) % steps_};
    return c.first < c.second ? c : Cell{c.second, c.first};
  }

  Approach refined(const std::map<Cell, double>& region) const {
    const auto nearest = std::ranges::min_element(region, {}, [](const auto& entry) { return entry.second; });
    const auto distance = [&](double s, double t) { return length(at(s) - at(t)); };
    // Where the tube meets itself at a small angle the nearest place may lie some steps off: follow the
    // valley.
    Approach result{nearest->first.first * step_, nearest->first.second * step_, 0, {}};
    for (int round = 0; round < 30; ++round) {
      const auto beside = [&](double s) {
        return least_at(result.t, 3 * step_, [&](double t) { return distance(s, t); });
      };
      const double before = result.s;
      result.s = least_at(before, 1.5 * step_, [&](double s) { return distance(s, beside(s)); });
      result.t = beside(result.s);
      if (std::abs(result.s - before) < 1.4 * step_) break;  // inside what was searched
    }
    result.distance = distance(result.s, result.t);
    std::map<std::int32_t, std::pair<double, std::int32_t>> best;  // by row
    for (const auto& [cell, d] : region) {
      const auto [row, fresh] = best.emplace(cell.first, std::pair{d, cell.second});
      if (!fresh) row->second = std::min(row->second, {d, cell.second});
    }
    for (const auto& [i, there] : best) result.rows.push_back({i * step_, there.second * step_});
    return result;
  }

  Vec3 at(double s) const {
    if (tube_.closed) return tube_.position(s - tube_.length * std::floor(s / tube_.length));
    return tube_.position(std::clamp(s, 0.0, tube_.length));
  }

  const Tube& tube_;
  std::int32_t steps_;
  double step_ = 0;
  std::vector<Vec3> points_;
  std::map<Cell, double> cells_;
};

}  // namespace

std::vector<Approach> approaches(const Tube& tube) { return Search(tube).run(); }

std::vector<Approach> contacts(const Tube& tube, const std::vector<Approach>& all) {
  std::vector<Approach> touching;
  std::ranges::copy_if(all, std::back_inserter(touching),
                       [&](const Approach& a) { return a.depth(tube.radius) >= 0; });
  return touching;
}

}  // namespace catena::bench
