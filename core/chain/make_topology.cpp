#include "catena/core/chain/make_topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "catena/core/chain/centre_distance.h"
#include "catena/core/error.h"

namespace catena {
namespace {

void check_strands(Strands& strands, std::uint32_t n) {
  auto& first = strands.first;
  if (first.empty()) first = {0, n};
  if (first.size() < 2 || first.front() != 0 || first.back() != n)
    throw InputError(fmt::format("strand offsets must run from 0 to {}", n));
  for (std::size_t s = 0; s + 1 < first.size(); ++s)
    if (first[s] > first[s + 1])
      throw InputError(
          fmt::format("strand {} ends before it starts: offsets {} and {}", s, first[s], first[s + 1]));
  if (strands.closed.empty()) strands.closed.assign(first.size() - 1, 0);
  if (strands.closed.size() != first.size() - 1)
    throw InputError(fmt::format("{} strands need {} closed flags, got {}", first.size() - 1,
                                 first.size() - 1, strands.closed.size()));
}

void check_exclusion(Exclusion& exclusion, std::uint32_t n) {
  if (exclusion.rule == Exclusion::Rule::index_window && exclusion.window < 1)
    throw InputError("the exclusion window must be at least 1");
  if (exclusion.rule == Exclusion::Rule::arc_window &&
      !(std::isfinite(exclusion.factor) && exclusion.factor > 0))
    throw InputError(fmt::format("the arc window must be a finite number above 0, got {}", exclusion.factor));
  auto& pairs = exclusion.extra_pairs;
  for (Pair& p : pairs) {
    if (p.i >= n || p.j >= n || p.i == p.j)
      throw InputError(
          fmt::format("extra pair ({}, {}) does not name two spheres of a chain of {}", p.i, p.j, n));
    if (p.i > p.j) std::swap(p.i, p.j);
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  if (pairs.size() >= std::size_t{1} << 31)  // both directions of each are numbered in 32 bits
    throw InputError(fmt::format("{} extra pairs are too many: at most 2^31 - 1", pairs.size()));
}

void index_strands(Topology& t, std::uint32_t n) {
  const auto& first = t.strands.first;
  if (first.size() == 2 && t.strands.closed[0] == 0) return;  // one open strand is never looked up
  t.strand_of.resize(n);
  for (std::uint32_t s = 0; s + 1 < first.size(); ++s)
    std::fill(t.strand_of.begin() + first[s], t.strand_of.begin() + first[s + 1], s);
}

void index_extra_pairs(Topology& t, std::uint32_t n) {
  const auto& pairs = t.exclusion.extra_pairs;
  if (pairs.empty()) return;
  t.extra_row.assign(n + 1, 0);
  for (const Pair& p : pairs) ++t.extra_row[p.i + 1], ++t.extra_row[p.j + 1];
  for (std::uint32_t i = 0; i < n; ++i) t.extra_row[i + 1] += t.extra_row[i];
  t.extra.resize(t.extra_row.back());
  std::vector<std::uint32_t> next(t.extra_row.begin(), t.extra_row.end() - 1);
  for (const Pair& p : pairs) t.extra[next[p.i]++] = p.j, t.extra[next[p.j]++] = p.i;
}

void measure_arcs(Topology& t, const std::vector<Sphere>& spheres) {
  t.arc.resize(spheres.size());
  t.loop_length.resize(t.strands.closed.size());
  for (std::uint32_t s = 0; s < t.loop_length.size(); ++s) {
    const std::uint32_t first = t.strands.first[s], last = t.strands.first[s + 1];
    double length = 0;
    for (std::uint32_t i = first; i < last; ++i) {
      if (i > first) length += centre_distance(spheres[i - 1], spheres[i]);
      t.arc[i] = length;
    }
    t.loop_length[s] = last > first ? length + centre_distance(spheres[last - 1], spheres[first]) : 0;
  }
}

void take_arcs(Topology& t, std::size_t n, ArcLengths& known) {
  const auto finite = [](const std::vector<double>& lengths) {
    return std::ranges::all_of(lengths, [](double length) { return std::isfinite(length); });
  };
  if (known.arc.size() != n || known.loop_length.size() != t.strands.closed.size())
    throw InputError(fmt::format("{} spheres on {} strands need as many arc lengths, got {} and {}", n,
                                 t.strands.closed.size(), known.arc.size(), known.loop_length.size()));
  if (!finite(known.arc) || !finite(known.loop_length)) throw InputError("an arc length is not finite");
  for (std::size_t s = 0; s < t.strands.closed.size(); ++s)
    if (!std::is_sorted(known.arc.begin() + t.strands.first[s], known.arc.begin() + t.strands.first[s + 1]))
      throw InputError(fmt::format("arc lengths fall along strand {}", s));
  t.arc = std::move(known.arc);
  t.loop_length = std::move(known.loop_length);
}

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

std::shared_ptr<const Topology> make_topology(const std::vector<Sphere>& spheres, Strands strands,
                                              Exclusion exclusion, ArcLengths* known) {
  const auto n = static_cast<std::uint32_t>(spheres.size());
  auto topology = std::make_shared<Topology>();
  topology->strands = std::move(strands);
  topology->exclusion = std::move(exclusion);
  check_strands(topology->strands, n);
  check_exclusion(topology->exclusion, n);
  index_strands(*topology, n);
  index_extra_pairs(*topology, n);
  if (topology->exclusion.rule == Exclusion::Rule::arc_window)
    known != nullptr ? take_arcs(*topology, n, *known) : measure_arcs(*topology, spheres);
  topology->number = next_number();
  return topology;
}

}  // namespace catena
