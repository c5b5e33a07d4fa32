#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/host_device.h"
#include "catena/core/pair.h"
#include "catena/core/sphere.h"

namespace catena {

/// Who counts as a neighbour, and so never collides. Fixed when the chain is made.
struct CATENA_API Exclusion {
  enum class Rule {
    /// On one strand |i - j| <= window, cyclic when the strand is closed (the paper: window 1).
    index_window,
    /// Nearer along the strand than factor * (ri + rj).
    arc_window
  };
  Rule rule = Rule::index_window;
  std::uint32_t window = 1;  ///< index window k >= 1
  double factor = 0;         ///< arc window f > 0, finite; pi/2 is what a tube of that thickness can bend
  std::vector<Pair> extra_pairs;  ///< further neighbours: branch joints, ring closures

  static Exclusion index(std::uint32_t k) { return {Rule::index_window, k, 0, {}}; }
  static Exclusion arc(double f) { return {Rule::arc_window, 0, f, {}}; }
};

/// The index window: spheres so many steps apart on a strand of `size` spheres, around its end when that is
/// closed.
template <class Number>
CATENA_HD bool within_index_window(Number steps, Number size, bool closed, Number window) {
  return steps <= window || (closed && size - steps <= window);
}

/// The arc window: spheres at these arc lengths of a strand, around its end when that is closed.
CATENA_HD inline bool within_arc_window(double arc_i, double arc_j, bool closed, double loop_length,
                                        double factor, float radius_i, float radius_j) {
  const double ahead = arc_i < arc_j ? arc_j - arc_i : arc_i - arc_j;
  double nearest = ahead;
  if (closed && loop_length - ahead < ahead) nearest = loop_length - ahead;
  return nearest < factor * (static_cast<double>(radius_i) + static_cast<double>(radius_j));
}

/// The exclusion rule as plain pointers, valid in one memory space. A pure function of the chain: the same
/// comparison of the same stored numbers on host and device.
struct CATENA_API ExclusionView {
  Exclusion::Rule rule;
  bool one_open_strand;  ///< then strand_of, strand_first and strand_closed need not be read
  bool window_alone;     ///< all there is to it is an index window on one open strand
  std::uint32_t window;
  double factor;
  const std::uint32_t* id;  ///< n entries: number on the one open strand that all are of; nullptr: as here
  std::uint32_t ascends_from, ascends_to;  ///< from the one sphere up to the other numbers ascend
  const std::uint32_t* strand_of;          ///< n entries: strand of a sphere
  const std::uint32_t* strand_first;       ///< strands + 1 offsets
  const std::uint8_t* strand_closed;       ///< one flag a strand
  const double* arc;               ///< n entries, arc rule only: arc length from the strand's first sphere
  const double* loop_length;       ///< one a strand, arc rule only: length of the closed loop
  const std::uint32_t* extra_row;  ///< n + 1 offsets into extra, or nullptr when there are no extra pairs
  const std::uint32_t* extra;      ///< partners of a sphere, both directions; those of each ascend

  /// True when i and j (i != j) are neighbours. O(1) but for extra pairs, O(log p) for p of them at i.
  CATENA_HD bool neighbours(std::uint32_t i, std::uint32_t j, float radius_i, float radius_j) const {
    if (window_alone) return within_window(i, j, 0, false);
    std::uint32_t first = 0, size = 0;
    bool closed = false;
    if (!one_open_strand) {
      const std::uint32_t strand = strand_of[i];
      if (strand != strand_of[j]) return extra_row != nullptr && listed(i, j);
      first = strand_first[strand];
      size = strand_first[strand + 1] - first;
      closed = strand_closed[strand] != 0;
      if (rule == Exclusion::Rule::arc_window && arc_neighbours(i, j, radius_i, radius_j, closed, strand))
        return true;
    } else if (rule == Exclusion::Rule::arc_window && arc_neighbours(i, j, radius_i, radius_j, false, 0)) {
      return true;
    }
    if (rule == Exclusion::Rule::index_window && within_window(i, j, size, closed)) return true;
    return extra_row != nullptr && listed(i, j);
  }

 private:
  CATENA_HD bool arc_neighbours(std::uint32_t i, std::uint32_t j, float ri, float rj, bool closed,
                                std::uint32_t strand) const {
    // Read only where there is a loop.
    const double loop = closed ? loop_length[strand] : 0;
    return within_arc_window(arc[i], arc[j], closed, loop, factor, ri, rj);
  }
  CATENA_HD bool within_window(std::uint32_t i, std::uint32_t j, std::uint32_t size, bool closed) const {
    const std::uint32_t apart = distance(i, j);
    if (id == nullptr) return within_index_window(apart, size, closed, window);
    // Numbers that ascend are no nearer to one another than their places are: few need be read.
    if (apart > window && ascends(i) && ascends(j)) return false;
    return distance(id[i], id[j]) <= window;
  }
  CATENA_HD bool ascends(std::uint32_t i) const { return i >= ascends_from && i < ascends_to; }
  CATENA_HD static std::uint32_t distance(std::uint32_t i, std::uint32_t j) { return i < j ? j - i : i - j; }
  CATENA_HD bool listed(std::uint32_t i, std::uint32_t j) const {
    std::uint32_t begin = extra_row[i], end = extra_row[i + 1];
    while (begin < end) {
      const std::uint32_t middle = begin + (end - begin) / 2;
      if (extra[middle] == j) return true;
      extra[middle] < j ? begin = middle + 1 : end = middle;
    }
    return false;
  }
};

}  // namespace catena
