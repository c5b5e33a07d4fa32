#include "catena/core/chain/chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "catena/core/error.h"

namespace catena {
namespace {

constexpr std::size_t max_spheres = (std::size_t{1} << 31) - 1;

double distance(const Sphere& a, const Sphere& b) {
  const double dx = double{b.x} - a.x, dy = double{b.y} - a.y, dz = double{b.z} - a.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

Extent extent_of(const std::vector<Sphere>& spheres) {
  if (spheres.empty()) return {};
  Sphere low = spheres[0], high = spheres[0];
  for (const Sphere& s : spheres) {
    low = {std::min(low.x, s.x), std::min(low.y, s.y), std::min(low.z, s.z), std::min(low.radius, s.radius)};
    high = {std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z), std::max(high.radius, s.radius)};
  }
  return {low.radius, high.radius, (double{high.x} - low.x) + (double{high.y} - low.y) + (double{high.z} - low.z)};
}

}  // namespace

Chain::Chain(std::vector<Sphere> spheres, Strands strands, Exclusion exclusion)
    : spheres_(std::move(spheres)), strands_(std::move(strands)), exclusion_(std::move(exclusion)) {
  check_spheres();
  check_strands();
  check_exclusion();
  index_strands();
  index_extra_pairs();
  if (exclusion_.rule == Exclusion::Rule::arc_window) measure_arcs();
}

Chain Chain::moved(std::vector<Sphere> spheres) const {
  if (spheres.size() != spheres_.size())
    throw InputError(
        fmt::format("a moved chain must keep its {} spheres, got {}", spheres_.size(), spheres.size()));
  Chain result(*this);
  result.spheres_ = std::move(spheres);
  result.check_spheres();
  return result;
}

ChainView Chain::view() const noexcept {
  const bool one_open = strand_count() == 1 && strands_.closed[0] == 0;
  return {spheres_.data(),
          size(),
          strand_count(),
          static_cast<std::uint32_t>(extra_.size()),
          {exclusion_.rule, one_open, exclusion_.window, exclusion_.factor, strand_of_.data(),
           strands_.first.data(), strands_.closed.data(), arc_.data(), loop_length_.data(),
           extra_row_.empty() ? nullptr : extra_row_.data(), extra_.data()},
          extent_};
}

void Chain::check_spheres() {
  if (spheres_.size() > max_spheres)
    throw InputError(fmt::format("a chain holds at most {} spheres, got {}", max_spheres, spheres_.size()));
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const Sphere& s = spheres_[i];
    if (!std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.z) || !std::isfinite(s.radius))
      throw InputError(
          fmt::format("sphere {} is not finite: x={} y={} z={} radius={}", i, s.x, s.y, s.z, s.radius));
    if (s.radius < 0) throw InputError(fmt::format("sphere {} has the negative radius {}", i, s.radius));
  }
  extent_ = extent_of(spheres_);
}

void Chain::check_strands() {
  auto& first = strands_.first;
  if (first.empty()) first = {0, size()};
  if (first.size() < 2 || first.front() != 0 || first.back() != size())
    throw InputError(fmt::format("strand offsets must run from 0 to {}", size()));
  for (std::size_t s = 0; s + 1 < first.size(); ++s)
    if (first[s] > first[s + 1])
      throw InputError(
          fmt::format("strand {} ends before it starts: offsets {} and {}", s, first[s], first[s + 1]));
  if (strands_.closed.empty()) strands_.closed.assign(first.size() - 1, 0);
  if (strands_.closed.size() != first.size() - 1)
    throw InputError(fmt::format("{} strands need {} closed flags, got {}", first.size() - 1,
                                 first.size() - 1, strands_.closed.size()));
}

void Chain::check_exclusion() {
  if (exclusion_.rule == Exclusion::Rule::index_window && exclusion_.window < 1)
    throw InputError("the exclusion window must be at least 1");
  if (exclusion_.rule == Exclusion::Rule::arc_window &&
      !(std::isfinite(exclusion_.factor) && exclusion_.factor > 0))
    throw InputError(
        fmt::format("the arc window must be a finite number above 0, got {}", exclusion_.factor));
  for (Pair& p : exclusion_.extra_pairs) {
    if (p.i >= size() || p.j >= size() || p.i == p.j)
      throw InputError(
          fmt::format("extra pair ({}, {}) does not name two spheres of a chain of {}", p.i, p.j, size()));
    if (p.i > p.j) std::swap(p.i, p.j);
  }
  std::ranges::sort(exclusion_.extra_pairs);
  auto& pairs = exclusion_.extra_pairs;
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

void Chain::index_strands() {
  if (strand_count() == 1 && strands_.closed[0] == 0) return;  // one open strand is never looked up
  strand_of_.resize(size());
  for (std::uint32_t s = 0; s < strand_count(); ++s)
    std::fill(strand_of_.begin() + strands_.first[s], strand_of_.begin() + strands_.first[s + 1], s);
}

void Chain::index_extra_pairs() {
  if (exclusion_.extra_pairs.empty()) return;
  extra_row_.assign(size() + 1, 0);
  for (const Pair& p : exclusion_.extra_pairs) ++extra_row_[p.i + 1], ++extra_row_[p.j + 1];
  for (std::uint32_t i = 0; i < size(); ++i) extra_row_[i + 1] += extra_row_[i];
  extra_.resize(extra_row_.back());
  std::vector<std::uint32_t> next(extra_row_.begin(), extra_row_.end() - 1);
  for (const Pair& p : exclusion_.extra_pairs) extra_[next[p.i]++] = p.j, extra_[next[p.j]++] = p.i;
}

void Chain::measure_arcs() {
  arc_.resize(size());
  loop_length_.resize(strand_count());
  for (std::uint32_t s = 0; s < strand_count(); ++s) {
    const std::uint32_t first = strands_.first[s], last = strands_.first[s + 1];
    double length = 0;
    for (std::uint32_t i = first; i < last; ++i) {
      if (i > first) length += distance(spheres_[i - 1], spheres_[i]);
      arc_[i] = length;
    }
    loop_length_[s] = last > first ? length + distance(spheres_[last - 1], spheres_[first]) : 0;
  }
}

}  // namespace catena
