#pragma once
#include <cstdint>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/met.h"
#include "catena/core/cells/sphere_cells.h"

namespace catena {

/// Some of 32 places side by side: bit k is that of first + k.
struct PlaceSet {
  std::uint32_t first, bits;
};

/// Who may collide with the sphere at a place: of what comes after it in its own cell, of the thirteen cells
/// of its level that come after that one, and of all 27 of each coarser level; so each pair is met once.
/// Tells the sink, which asks met() of each in its own time: sink.near(search, place, level, sets) by
/// all threads of a warp together, `sets` an array of PlaceSet, and sink.near_too(search, place, level, set)
/// by a thread alone. A sink that `listens`, which only one on the host does, is also told of each cell that
/// a sphere looks into, sink.looks(i, level, bits), bit 3 r + 1 + x for that x further on in row r, and of
/// each sphere it is compared with, sink.compared(i, j, level).
template <class Tests, bool equal_radii, class Sink>
class CellSearch {
 public:
  CATENA_HD CellSearch(const ChainView& chain, const SphereCells& cells, const CellTable& table, Sink& sink)
      : chain_(chain), cells_(cells), placed_(cells), table_(table), sink_(sink) {}

  /// All threads of a warp come to these two together; one that is not `live` has no place, and any for
  /// `place` will do. This one is for spheres in one level, the other for those sorted by octaves.
  CATENA_HD void run_in_one_level(const Sphere& s, std::uint32_t place, bool live) const {
    look<own_row>({s, place, 0, 0, live});
  }
  CATENA_HD void run(const Sphere& s, std::uint32_t place, bool live) const {
    const std::uint32_t octave = cells_.octaves.of(s.radius);
    for (std::uint32_t word = 0; word < Octaves::count / 32; ++word) {
      const std::uint32_t levels = cells_.state->levels[word];
      for (std::uint32_t level = word * 32; levels >> level % 32 != 0; ++level) {
        if ((levels >> level % 32 & 1) && sink_.any(live && level <= octave))
          look<0>({s, place, octave, level, live && level <= octave});
        if (level % 32 == 31) break;
      }
    }
  }

  /// Of the spheres at these places, the second in a cell of that level, which they are and whether they
  /// collide. Neighbours are known first: where tubes are drawn tightest they touch to the last bit, and that
  /// is the dearest to decide.
  CATENA_HD Met met(std::uint32_t place, std::uint32_t at, std::uint32_t level) const {
    const auto a = placed_.at(place), b = placed_.at(at);
    const bool of_level = equal_radii || cells_.one_level() || cells_.octaves.of(b.sphere.radius) == level;
    return {a.index, b.index,
            of_level && !chain_.exclusion.neighbours(a.index, b.index, a.sphere.radius, b.sphere.radius) &&
                Tests::overlap(a.sphere, b.sphere)};
  }
  CATENA_HD std::uint32_t sphere_at(std::uint32_t place) const { return placed_.index(place); }

 private:
  static constexpr std::uint32_t own_row = 4, rows = 9;

  /// One sphere that looks into one level.
  struct Look {
    Sphere sphere;
    std::uint32_t place, octave, level;
    bool live;
    CATENA_HD bool own() const { return octave == level; }
  };
  /// Cells next to one another along x.
  struct Row {
    std::uint32_t from, cells;
  };

  template <std::uint32_t first_row>
  CATENA_HD void look(const Look& of) const {
    const PointCell at = cells_.cell(of.sphere, of.level);
    const std::uint32_t bucket = table_.bucket(at, of.level);
    const float reach = cells_.reach(of.sphere, of.level), limit = reach * reach + 0x1p-20f;
    Buckets::Run run[rows - first_row];  // all asked for before the first is waited for
    std::uint32_t longer = 0;
    sink_.converge();
    for (std::uint32_t r = first_row; r < rows; ++r) {
      Row row = this->row(r, of, at, bucket, limit);
      if constexpr (listens) tell_looks(r, of, bucket, row);
      Buckets::Run& of_row = run[r - first_row] = {0, 0};
      if (row.cells > 0) of_row = take(r, of, row);
      longer |= static_cast<std::uint32_t>(row.cells > 0 || of_row.end - of_row.first > batch) << r;
    }
    PlaceSet found[rows - first_row];
    for (std::uint32_t k = 0; k < rows - first_row; ++k) found[k] = {run[k].first, near(of, run[k])};
    sink_.near(*this, of.place, of.level, found);
    if (!sink_.any(longer != 0)) return;
    for (; longer != 0; longer &= longer - 1) look_further(lowest_bit(longer), of, at, bucket, limit);
    sink_.converge();
  }

  /// What a row has beyond the first places side by side, and beyond the first batch of these.
  CATENA_HD void look_further(std::uint32_t r, const Look& of, const PointCell& at, std::uint32_t bucket,
                              float limit) const {
    Row row = this->row(r, of, at, bucket, limit);
    Buckets::Run run = take(r, of, row);
    run.first += batch;
    for (;; run = cells_.buckets.take(table_, row.from, row.cells)) {
      for (; run.first < run.end; run.first += batch)
        sink_.near_too(*this, of.place, of.level, {run.first, near(of, run)});
      if (row.cells == 0) return;
    }
  }

  /// The cells of a row that the sphere can reach, of the three next to its own: those whose square of the
  /// distance, in cells, is at most `limit`, above which there is nothing it overlaps
  /// (properties/proofs/cell_rows.g).
  CATENA_HD Row row(std::uint32_t r, const Look& of, const PointCell& at, std::uint32_t bucket,
                    float limit) const {
    const float y = gap(at.y, r % 3), z = gap(at.z, r / 3), off = y * y + z * z;
    if (!of.live || off > limit || (of.own() && r < own_row)) return {0, 0};
    const bool left = !starts_at_itself(r, of) && reaches(at.x.below, off, limit);
    const std::uint32_t middle = table_.on(bucket, table_.step[r]);
    return {left ? table_.before(middle) : middle,
            1u + (left ? 1 : 0) + (reaches(at.x.above, off, limit) ? 1 : 0)};
  }
  CATENA_HD static bool starts_at_itself(std::uint32_t r, const Look& of) { return r == own_row && of.own(); }
  CATENA_HD static float gap(const AxisCell& at, std::uint32_t way) {
    return way == 0 ? at.below : way == 2 ? at.above : 0;
  }
  CATENA_HD static bool reaches(float along, float off, float limit) { return along * along + off <= limit; }

  /// The first part of a row that lies side by side; of its own bucket what comes after the sphere.
  CATENA_HD Buckets::Run take(std::uint32_t r, const Look& of, Row& row) const {
    Buckets::Run run = cells_.buckets.take(table_, row.from, row.cells);
    if (starts_at_itself(r, of)) run.first = of.place + 1;
    return run;
  }

  static constexpr std::uint32_t batch = 32;

  /// Of the first `batch` of these places those whose spheres are not separate for certain from s.
  CATENA_HD std::uint32_t near(const Look& of, const Buckets::Run& run) const {
    const Sphere& s = of.sphere;
    std::uint32_t bits = 0, end = run.end;
    if (end > run.first + batch) end = run.first + batch;
    if constexpr (listens)
      for (std::uint32_t at = run.first; at < end; ++at)
        sink_.compared(placed_.index(of.place), placed_.index(at), of.level);
    for (std::uint32_t at = run.first; at < end; at += SphereCells::at_once) {
      const Sphere* const these = cells_.sphere + at;
      std::uint32_t of_these = 0;
      for (std::uint32_t k = 0; k < SphereCells::at_once; ++k)
        of_these |= static_cast<std::uint32_t>(!Tests::separate(s, placed_.sphere(these[k]))) << k;
      bits |= of_these << (at - run.first);
    }
    return end - run.first < batch ? bits & ((1u << (end - run.first)) - 1) : bits;
  }

  static constexpr bool listens = requires(Sink sink) { sink.compared(0u, 0u, 0u); };
  void tell_looks(std::uint32_t r, const Look& of, std::uint32_t bucket, const Row& row) const {
    const bool left = row.from != table_.on(bucket, table_.step[r]);
    const std::uint32_t cells = (1u << row.cells) - 1;  // the middle one is the second of three
    sink_.looks(placed_.index(of.place), of.level, (left ? cells : cells << 1) << (3 * r));
  }

  const ChainView& chain_;
  const SphereCells& cells_;
  const PlacedSpheres<equal_radii> placed_;
  const CellTable& table_;
  Sink& sink_;
};

}  // namespace catena
