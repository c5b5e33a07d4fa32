#include "catena/reference/find_in_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "catena/core/error.h"

namespace catena::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Place = std::array<double, 3>;

/// How many whole edges b is moved by.
using Steps = std::array<double, 3>;

bool overlap_by_rationals(const Sphere& a, const Sphere& b, const Steps& n, const PeriodicBox& box) {
  const Rational x = Rational(n[0]), y = Rational(n[1]), z = Rational(n[2]);
  const Rational dx = Rational(b.x) - Rational(a.x) + x * Rational(box.length[0]) + y * Rational(box.xy) +
                      z * Rational(box.xz),
                 dy = Rational(b.y) - Rational(a.y) + y * Rational(box.length[1]) + z * Rational(box.yz),
                 dz = Rational(b.z) - Rational(a.z) + z * Rational(box.length[2]),
                 reach = Rational(a.radius) + Rational(b.radius);
  return dx * dx + dy * dy + dz * dz <= reach * reach;
}

// Each difference is a sum of at most five terms, so its error is below 6u of `most`, the sum of all
// magnitudes (u = 2^-53); q and t differ from the truth by less than 64u of its square. 2^-46 is twice that.
bool overlap(const Sphere& a, const Sphere& b, const Steps& n, const PeriodicBox& box) {
  const double dx = (double{b.x} - a.x) + n[0] * box.length[0] + n[1] * box.xy + n[2] * box.xz,
               dy = (double{b.y} - a.y) + n[1] * box.length[1] + n[2] * box.yz,
               dz = (double{b.z} - a.z) + n[2] * box.length[2], reach = double{a.radius} + b.radius;
  double most = reach;
  for (const double term :
       {double{a.x}, double{a.y}, double{a.z}, double{b.x}, double{b.y}, double{b.z}, n[0] * box.length[0],
        n[1] * box.xy, n[2] * box.xz, n[1] * box.length[1], n[2] * box.yz, n[2] * box.length[2]})
    most += std::abs(term);
  const double q = dx * dx + dy * dy + dz * dz, t = reach * reach;
  if (std::abs(q - t) > 0x1p-46 * most * most) return q < t;
  return overlap_by_rationals(a, b, n, box);
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

  bool collide(std::uint32_t i, std::uint32_t j) const {
    Steps nearest{};
    for (std::size_t edge = 0; edge < 3; ++edge)
      nearest[edge] = std::round(place_[i][edge] - place_[j][edge]);
    const auto beside = [&](std::size_t edge, int step) { return box_.length[edge] > 0 || step == 0; };
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (beside(0, x) && beside(1, y) && beside(2, z) &&
              overlap(chain_[i], chain_[j], {nearest[0] + x, nearest[1] + y, nearest[2] + z}, box_))
            return true;
    return false;
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

}  // namespace catena::reference
