#pragma once
#include <algorithm>
#include <cstdint>

#include "catena/core/cells/sphere_cells.h"

namespace catena {

/// Finds the pairs of the sphere at a place: with what comes after it in its own cell, with the thirteen cells of its
/// level that come after that one, and with all 27 of each coarser level; so each pair is met once. Tells them to
/// sink.pair(i, j), i < j.
template <class Tests, class Sink>
class CellSearch {
 public:
  CATENA_HD CellSearch(const ChainView& chain, const SphereCells& cells, const CellTable& table, Sink& sink)
      : chain_(chain), cells_(cells), table_(table), sink_(sink) {}

  CATENA_HD void run(std::uint32_t place) const {
    const Sphere s = cells_.sphere[place];
    const std::uint32_t octave = cells_.octaves.of(s.radius);
    within(s, place, octave);
    if (cells_.octaves.one) return;
    for (std::uint32_t coarser = 0; coarser < octave; ++coarser)
      if (cells_.state->levels >> coarser & 1) {
        const PointCell at = cells_.cell(s, coarser);
        const std::uint32_t bucket = table_.bucket(at, coarser);
        for (std::uint32_t r = 0; r < 9; ++r) row(r, s, place, at, bucket, coarser);
      }
  }

 private:
  static constexpr std::uint32_t own_row = 4;

  CATENA_HD void within(const Sphere& s, std::uint32_t place, std::uint32_t octave) const {
    const PointCell at = cells_.cell(s, octave);
    const std::uint32_t bucket = table_.bucket(at, octave);
    bool own = true;  // the first run begins in the own bucket
    runs(bucket, 1 + reaches(at.x.above, 0), [&](std::uint32_t first, std::uint32_t end) {
      meet(s, place, own ? place + 1 : first, end, octave);
      own = false;
    });
    for (std::uint32_t r = own_row + 1; r < 9; ++r) row(r, s, place, at, bucket, octave);
  }

  /// The cells of a row that the sphere can reach, of the three next to its own: what it overlaps lies less than one
  /// cell away, by so much that no rounding of these distances matters (properties/proofs/grid_cells.g).
  CATENA_HD void row(std::uint32_t r, const Sphere& s, std::uint32_t place, const PointCell& at, std::uint32_t bucket,
                     std::uint32_t level) const {
    const float y = gap(at.y, r % 3), z = gap(at.z, r / 3), off = y * y + z * z;
    if (!(off <= 1)) return;
    const std::uint32_t left = reaches(at.x.below, off), right = reaches(at.x.above, off);
    const std::uint32_t to = table_.on(bucket, table_.step[r]);
    runs(left ? table_.before(to) : to, 1 + left + right,
         [&](std::uint32_t first, std::uint32_t end) { meet(s, place, first, end, level); });
  }
  CATENA_HD static float gap(const AxisCell& at, std::uint32_t way) {
    return way == 0 ? at.below : way == 2 ? at.above : 0;
  }
  CATENA_HD static std::uint32_t reaches(float along, float off) { return along * along + off <= 1 ? 1 : 0; }

  /// Calls visit(first, end) with the places of these buckets: mostly once, else where a chunk or the table ends.
  template <class Visit>
  CATENA_HD void runs(std::uint32_t bucket, std::uint32_t buckets, const Visit& visit) const {
    while (buckets > 0) {
      const std::uint32_t of_chunk = SphereCells::chunk - bucket % SphereCells::chunk,
                          of_table = table_.buckets - bucket, room = of_chunk < of_table ? of_chunk : of_table,
                          take = buckets < room ? buckets : room;
      const std::uint32_t* const start = cells_.start + SphereCells::start_of(bucket);
      visit(start[0], start[take]);
      buckets -= take;
      bucket = table_.on(bucket, take);
    }
  }

  CATENA_HD void meet(const Sphere& s, std::uint32_t place, std::uint32_t first, std::uint32_t end,
                      std::uint32_t level) const {
    for (std::uint32_t at = first; at < end; ++at) {
      const Sphere other = cells_.sphere[at];
      if (!Tests::separate(s, other)) met(s, place, other, at, level);
    }
  }

  CATENA_HD void met(const Sphere& s, std::uint32_t place, const Sphere& other, std::uint32_t at,
                     std::uint32_t level) const {
    if (!Tests::overlap(s, other) || cells_.octaves.of(other.radius) != level) return;
    const std::uint32_t a = cells_.index[place], b = cells_.index[at], i = a < b ? a : b, j = a < b ? b : a;
    if (!chain_.neighbours(i, j)) sink_.pair(i, j);
  }

  const ChainView& chain_;
  const SphereCells& cells_;
  const CellTable& table_;
  Sink& sink_;
};

}  // namespace catena
