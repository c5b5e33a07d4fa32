#include "catena/reference/all_pairs.h"

#include <algorithm>
#include <cmath>

#include "catena/reference/exact_gap.h"
#include "catena/reference/tally.h"

namespace catena::reference {
namespace {

/// Structure of arrays, already in binary64, so that the sieve vectorises.
struct Columns {
  std::vector<double> x, y, z, radius;

  explicit Columns(std::span<const Sphere> spheres) {
    for (auto* column : {&x, &y, &z, &radius}) column->reserve(spheres.size());
    for (const Sphere& s : spheres) {
      x.push_back(s.x);
      y.push_back(s.y);
      z.push_back(s.z);
      radius.push_back(s.radius);
    }
  }
  GapEstimate gap(std::uint32_t i, std::uint32_t j) const noexcept {
    return GapEstimate::of(x[i] - x[j], y[i] - y[j], z[i] - z[j], radius[i] + radius[j]);
  }
};

class Search {
 public:
  Search(const Chain& chain, const Request& request)
      : chain_(chain), view_(chain.view()), columns_(chain.spheres()), tally_(chain.size(), request) {}

  AllPairs run() && {
    constexpr std::uint32_t block = 64;
    const std::uint32_t n = chain_.size();
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = i + 1; j < n; j += std::min(block, n - j)) {
        const std::uint32_t end = j + std::min(block, n - j);
        if (worth_a_look(i, j, end))
          for (std::uint32_t k = j; k < end; ++k) look(i, k);
      }
    if (std::isfinite(tightest_.margin)) tightest_.margin = margin_of(tightest_.pair);
    return {std::move(tally_).finish(), tightest_};
  }

 private:
  /// The sieve: some pair of i with first..end-1 may overlap or be the tightest so far. Most blocks have
  /// none.
  bool worth_a_look(std::uint32_t i, std::uint32_t first, std::uint32_t end) const noexcept {
    // Local pointers and a mask as wide as a double: what the vectoriser needs to see.
    const double *x = columns_.x.data(), *y = columns_.y.data(), *z = columns_.z.data(),
                 *r = columns_.radius.data();
    const double xi = x[i], yi = y[i], zi = z[i], ri = r[i], reach = reach_;
    std::int64_t any = 0;
    for (std::uint32_t k = first; k < end; ++k) {
      const auto e = GapEstimate::of(xi - x[k], yi - y[k], zi - z[k], ri + r[k]);
      any |= e.gap <= reach * e.radii ? std::int64_t{-1} : std::int64_t{0};
    }
    return any != 0;
  }

  void look(std::uint32_t i, std::uint32_t j) {
    const auto e = columns_.gap(i, j);
    if (e.gap > reach_ * e.radii || view_.neighbours(i, j)) return;
    const bool hit = e.certain() ? e.gap < 0 : overlap(chain_[i], chain_[j]);
    if (hit) tally_.add(i, j);
    if (e.radii > 0 || hit)
      tighten(i, j, hit && e.radii == 0 ? 0 : std::fabs(e.gap) / e.radii);  // 0: equal points
  }

  void tighten(std::uint32_t i, std::uint32_t j, double rough) {
    // A rough margin above 2^-8 has relative error below 2^-50 * (2^9 + 1) + 4u < 2^-40; below, only exact
    // will do.
    // Nor is it far off: there the error is below 2^-50 (q + t) / t < 2^-48, and who is not a new least by
    // more than that needs no exact margin.
    const double at_least = rough > 0x1p-8 ? rough : rough - 0x1p-48;
    if (tightest_.margin == 0 || at_least >= tightest_.margin) return;
    const double m = rough > 0x1p-8 ? rough : margin(chain_[i], chain_[j]);
    if (m >= tightest_.margin) return;
    tightest_ = {{i, j}, m};
    // The sieve must let pass every pair that undercuts this margin or that the estimate leaves open. Their
    // gap is at most m * t or within the error of 0, and that error, 2^-50 (q + t), is below 2^-40 t + 2^-40
    // m t.
    reach_ = m * (1 + 0x1p-30) + 0x1p-40;
  }

  double margin_of(const Pair& p) const { return margin(chain_[p.i], chain_[p.j]); }

  const Chain& chain_;
  const ChainView view_;
  const Columns columns_;
  Tally tally_;
  Tightest tightest_;
  // Pairs with gap > reach_ * t are of no interest. It starts above every finite margin (they are below
  // 2^557), and finite itself: 0 * infinity would hide coincident points.
  double reach_ = 0x1p600;
};

}  // namespace

AllPairs all_pairs(const Chain& chain, const Request& request) { return Search(chain, request).run(); }

std::vector<double> margins(const Chain& chain, std::span<const Pair> pairs) {
  std::vector<double> result;
  result.reserve(pairs.size());
  for (const Pair& p : pairs) result.push_back(margin(chain[p.i], chain[p.j]));
  return result;
}

}  // namespace catena::reference
