#include "catena/reference/find_in_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/reference/reference.h"

namespace catena::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Place = std::array<double, 3>;

/// How many whole edges b is moved by.
using Steps = std::array<double, 3>;

struct Squares {
  Rational q, t;  ///< of the distance and of the sum of the radii
};

Squares squares(const Sphere& a, const Sphere& b, const Steps& n, const PeriodicBox& box) {
  const Rational x = Rational(n[0]), y = Rational(n[1]), z = Rational(n[2]);
  const Rational dx = Rational(b.x) - Rational(a.x) + x * Rational(box.length[0]) + y * Rational(box.xy) +
                      z * Rational(box.xz),
                 dy = Rational(b.y) - Rational(a.y) + y * Rational(box.length[1]) + z * Rational(box.yz),
                 dz = Rational(b.z) - Rational(a.z) + z * Rational(box.length[2]),
                 reach = Rational(a.radius) + Rational(b.radius);
  return {dx * dx + dy * dy + dz * dz, reach * reach};
}

bool overlap_by_rationals(const Sphere& a, const Sphere& b, const Steps& n, const PeriodicBox& box) {
  const Squares s = squares(a, b, n, box);
  return s.q <= s.t;
}

/// q and t rounded, and a bound of the error of q - t.
struct Rough {
  double q, t, error;
};

// Each difference is a sum of at most five terms, so its error is below 6u of `most`, the sum of all
// magnitudes (u = 2^-53): e = 2^-50 of that. The square of a difference d is then off by less than 2e|d| +
// e^2, and rounding q, t and q - t adds less than 8u(q + t). The bound is twice that, for its own rounding.
Rough rough(const Sphere& a, const Sphere& b, const Steps& n, const PeriodicBox& box) {
  const double dx = (double{b.x} - a.x) + n[0] * box.length[0] + n[1] * box.xy + n[2] * box.xz,
               dy = (double{b.y} - a.y) + n[1] * box.length[1] + n[2] * box.yz,
               dz = (double{b.z} - a.z) + n[2] * box.length[2], reach = double{a.radius} + b.radius;
  double most = 0;
  for (const double term :
       {double{a.x}, double{a.y}, double{a.z}, double{b.x}, double{b.y}, double{b.z}, n[0] * box.length[0],
        n[1] * box.xy, n[2] * box.xz, n[1] * box.length[1], n[2] * box.yz, n[2] * box.length[2]})
    most += std::abs(term);
  const double q = dx * dx + dy * dy + dz * dz, t = reach * reach, e = 0x1p-50 * most;
  return {q, t, 4 * e * (std::abs(dx) + std::abs(dy) + std::abs(dz)) + 6 * e * e + 0x1p-49 * (q + t)};
}

bool overlap(const Sphere& a, const Sphere& b, const Steps& n, const PeriodicBox& box) {
  const Rough r = rough(a, b, n, box);
  return std::abs(r.q - r.t) > r.error ? r.q < r.t : overlap_by_rationals(a, b, n, box);
}

/// Spheres in cells that are a reach wide at least, by where they are in the box.
class BoxCells {
 public:
  BoxCells(const Chain& chain, const PeriodicBox& box, double reach) : chain_(chain), box_(box) {
    const auto widths = box.widths();
    const double most = std::max(1.0, std::cbrt(static_cast<double>(chain.size())));
    for (std::size_t edge = 0; edge < 3; ++edge) {
      constexpr double slack = 1.001;  // for the rounding of places
      const double fit = reach > 0 ? widths[edge] / (reach * slack) : most;
      cells_[edge] = widths[edge] > 0 ? static_cast<std::size_t>(std::clamp(std::floor(fit), 1.0, most)) : 1;
    }
    members_.resize(cells_[0] * cells_[1] * cells_[2]);
    for (std::uint32_t i = 0; i < chain.size(); ++i) {
      place_.push_back(box.in_edges({double{chain[i].x}, double{chain[i].y}, double{chain[i].z}}));
      for (const double place : place_[i])
        if (std::abs(place) > 0x1p20)
          throw InputError(fmt::format("sphere {} lies more than 2^20 boxes away", i));
      members_[cell_of(i, {0, 0, 0})].push_back(i);
    }
  }

  /// visit(j) for each j > i in the cell of i or beside it, once.
  template <class Visit>
  void partners(std::uint32_t i, const Visit& visit) const {
    std::set<std::size_t> beside;  // a box of one or two cells is its own neighbour
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) beside.insert(cell_of(i, {x, y, z}));
    for (const std::size_t cell : beside)
      for (const std::uint32_t j : members_[cell])
        if (j > i) visit(j);
  }

  /// visit(Steps) for the image of j that is nearest along each edge, and those beside it.
  template <class Visit>
  void images(std::uint32_t i, std::uint32_t j, const Visit& visit) const {
    Steps nearest{};
    for (std::size_t edge = 0; edge < 3; ++edge)
      nearest[edge] = std::round(place_[i][edge] - place_[j][edge]);
    const auto beside = [&](std::size_t edge, int step) { return box_.length[edge] > 0 || step == 0; };
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (beside(0, x) && beside(1, y) && beside(2, z))
            visit(Steps{nearest[0] + x, nearest[1] + y, nearest[2] + z});
  }

  bool collide(std::uint32_t i, std::uint32_t j) const {
    bool any = false;
    images(i, j, [&](const Steps& n) { any = any || overlap(chain_[i], chain_[j], n, box_); });
    return any;
  }

  /// |q - t| / t for the nearest image, and whether it collides; infinite where it is plainly above 1.
  std::pair<double, bool> margin(std::uint32_t i, std::uint32_t j) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    double least = infinite, error = 0, t = 0;
    images(i, j, [&](const Steps& n) {
      const Rough r = rough(chain_[i], chain_[j], n, box_);
      least = std::min(least, r.q), error = std::max(error, r.error), t = r.t;
    });
    const double gap = least - t;
    if (gap - error > 1.0001 * t) return {infinite, false};
    const double m = std::abs(gap) / t;
    if (m > 0x1p-8 && std::abs(m - 1) > 0x1p-28 && error < 0x1p-30 * std::abs(gap)) return {m, gap < 0};
    Rational q = -1, touch;
    images(i, j, [&](const Steps& n) {
      if (rough(chain_[i], chain_[j], n, box_).q > least + 2 * error) return;
      const Squares s = squares(chain_[i], chain_[j], n, box_);
      if (q < 0 || s.q < q) q = s.q;
      touch = s.t;
    });
    const bool collides = q <= touch;
    if (q == touch) return {0, true};
    if (touch == 0) return {infinite, false};
    return {static_cast<double>(Rational(abs(q - touch) / touch)), collides};
  }

 private:
  std::size_t cell_of(std::uint32_t i, const std::array<int, 3>& step) const {
    std::size_t cell = 0;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const double inside = place_[i][edge] - std::floor(place_[i][edge]);
      const auto n = static_cast<std::int64_t>(cells_[edge]);
      const auto here = std::min(static_cast<std::int64_t>(inside * static_cast<double>(n)), n - 1);
      cell = cell * cells_[edge] + static_cast<std::size_t>((here + step[edge] + n) % n);
    }
    return cell;
  }

  const Chain& chain_;
  const PeriodicBox& box_;
  std::array<std::size_t, 3> cells_{};
  std::vector<Place> place_;  ///< in edges of the box
  std::vector<std::vector<std::uint32_t>> members_;
};

}  // namespace

Answer find_in_box(const Chain& chain, const PeriodicBox& box, std::uint64_t pair_limit) {
  const double reach = 2 * double{chain.view().extent.greatest_radius};
  check_box(box, reach);
  const BoxCells cells(chain, box, reach);
  Answer answer;
  answer.count.assign(chain.size(), 0);
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    cells.partners(i, [&](std::uint32_t j) {
      if (chain.neighbours(i, j) || !cells.collide(i, j)) return;
      ++answer.count[i], ++answer.count[j];
      if (++answer.pair_count <= pair_limit) answer.pairs.push_back({i, j});
    });
  answer.has_pairs = answer.pair_count <= pair_limit;
  if (!answer.has_pairs) answer.pairs.clear();
  std::ranges::sort(answer.pairs);
  return answer;
}

// A pair of interest is within sqrt(2) reaches, 0.71 of each width: less than one edge from the rounded
// place.
void near_pairs_in_box(const Chain& chain, const PeriodicBox& box, const NearVisitor& visit) {
  const double reach = 2 * double{chain.view().extent.greatest_radius};
  check_box(box, reach);
  const BoxCells cells(chain, box, 1.4143 * reach);
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    cells.partners(i, [&](std::uint32_t j) {
      if (chain.neighbours(i, j)) return;
      const auto [margin, collides] = cells.margin(i, j);
      if (margin < 1 || collides) visit({i, j}, collides, margin);
    });
}

Answer find_in(const Chain& chain, const PeriodicBox* box) {
  return box == nullptr ? find(chain) : find_in_box(chain, *box, Request{}.pair_limit);
}

}  // namespace catena::reference
