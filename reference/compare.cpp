#include "catena/reference/compare.h"

#include <algorithm>

#include "catena/reference/exact_gap.h"

namespace catena::reference {
namespace {

/// The answer's pairs in order, each once; what had to be left out is noted.
std::vector<Pair> tidy(std::vector<Pair> pairs, std::uint32_t n, Comparison& result) {
  result.malformed = std::erase_if(pairs, [n](const Pair& p) { return p.i >= p.j || p.j >= n; });
  std::ranges::sort(pairs);
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

void note(const Chain& chain, const Pair& pair, bool missing, Comparison& result) {
  const double m = margin(chain[pair.i], chain[pair.j]);
  ++(missing ? result.missing : result.invented);
  const bool neighbours = !missing && chain.neighbours(pair.i, pair.j);
  if (neighbours)
    ++result.neighbours;
  else
    result.worst_margin = std::max(result.worst_margin, m);
  if (result.examples.size() < Comparison::shown) result.examples.push_back({pair, missing, m});
}

void compare_pairs(const Chain& chain, const Answer& exact, const Collisions& found, Comparison& result) {
  const auto own = tidy(found.pairs, chain.size(), result);
  result.pairs = own.size();
  auto right = exact.pairs.begin();
  auto given = own.begin();
  while (right != exact.pairs.end() || given != own.end()) {
    if (given == own.end() || (right != exact.pairs.end() && *right < *given))
      note(chain, *right++, true, result);
    else if (right == exact.pairs.end() || *given < *right)
      note(chain, *given++, false, result);
    else
      ++right, ++given;
  }
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
