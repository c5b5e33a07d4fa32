#include "catena/reference/compare.h"

#include <algorithm>
#include <cmath>

#include "catena/reference/exact_gap.h"

namespace catena::reference {
namespace {

/// The answer's pairs in order, each once; what had to be left out is noted.
std::vector<Pair> tidy(std::vector<Pair> pairs, std::uint32_t n, Comparison& result) {
  result.malformed = std::erase_if(pairs, [n](const Pair& p) { return p.i >= p.j || p.j >= n; });
  std::ranges::sort(pairs, {}, [](const Pair& p) { return std::uint64_t{p.i} << 32 | p.j; });
  const auto again = std::unique(pairs.begin(), pairs.end());
  result.repeated = static_cast<std::uint64_t>(pairs.end() - again);
  pairs.erase(again, pairs.end());
  return pairs;
}

std::uint64_t differing(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  const std::size_t common = std::min(a.size(), b.size());
  std::uint64_t number = std::max(a.size(), b.size()) - common;
  for (std::size_t i = 0; i < common; ++i) number += a[i] != b[i];
  return number;
}

/// An upper bound of the margin, from the error bound of the estimate. Not a number for two points.
double margin_at_most(const Sphere& a, const Sphere& b) {
  const auto e = GapEstimate::of(a, b);
  return (std::fabs(e.gap) + 0x1p-50 * e.squares) / e.radii * (1 + 0x1p-50);
}

void note(const Chain& chain, const Pair& pair, bool missing, Comparison& result) {
  ++(missing ? result.missing : result.invented);
  const bool neighbours = !missing && chain.neighbours(pair.i, pair.j);
  result.neighbours += neighbours;
  const Sphere &a = chain[pair.i], &b = chain[pair.j];
  const bool shown = result.examples.size() < Comparison::shown;
  // Rounded arithmetic can be wrong in most pairs, and an exact margin costs as much as a search for a
  // sphere.
  if (!shown && (neighbours || margin_at_most(a, b) <= result.worst_margin)) return;
  const double m = margin(a, b);
  if (!neighbours) result.worst_margin = std::max(result.worst_margin, m);
  if (shown) result.examples.push_back({pair, missing, m});
}

void compare_lists(const Chain& chain, const std::vector<Pair>& exact, const std::vector<Pair>& own,
                   Comparison& result) {
  auto right = exact.begin();
  auto given = own.begin();
  while (right != exact.end() || given != own.end()) {
    if (given == own.end() || (right != exact.end() && *right < *given))
      note(chain, *right++, true, result);
    else if (right == exact.end() || *given < *right)
      note(chain, *given++, false, result);
    else
      ++right, ++given;
  }
}

void compare_pairs(const Chain& chain, const Answer& exact, const Collisions& found, Comparison& result) {
  const bool as_they_are = found.pairs == exact.pairs;  // most answers are right, and in order
  const auto tidied = as_they_are ? std::vector<Pair>() : tidy(found.pairs, chain.size(), result);
  const auto& own = as_they_are ? exact.pairs : tidied;
  result.pairs = own.size();
  if (!as_they_are) compare_lists(chain, exact.pairs, own, result);
  std::vector<std::uint32_t> counted(chain.size(), 0);
  for (const Pair& p : own) ++counted[p.i], ++counted[p.j];
  result.inconsistent_counts = differing(found.count, counted);
  result.wrong_total = found.pair_count != found.pairs.size() || found.found == found.pairs.empty();
}

}  // namespace

bool Comparison::right() const {
  return missing == 0 && invented == 0 && repeated == 0 && malformed == 0 && wrong_counts == 0 &&
         inconsistent_counts == 0 && !wrong_total;
}

Comparison compare_counts(const Answer& exact, const Collisions& found) {
  Comparison result;
  result.pairs = found.pair_count;
  result.wrong_counts = differing(found.count, exact.count);
  result.wrong_total = found.pair_count != exact.pair_count || found.found != (exact.pair_count > 0);
  return result;
}

Comparison compare(const Chain& chain, const Answer& exact, const Collisions& found) {
  if (!exact.has_pairs) return compare_counts(exact, found);
  Comparison result;
  result.wrong_counts = differing(found.count, exact.count);
  compare_pairs(chain, exact, found, result);
  return result;
}

}  // namespace catena::reference
