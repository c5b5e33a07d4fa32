#pragma once
#include <cstdint>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/met.h"
#include "catena/core/cells/sphere_cells.h"

namespace catena {

/// Some of 32 places side by side: bit 31 is that of `first`, which may lie before 0, bit 30 the next one's.
struct PlaceSet {
  std::uint32_t first, bits;
  /// The first of them, which it then is without; bits != 0.
  CATENA_HD std::uint32_t take() { return first + take_highest(bits); }
};

/// Who may collide with the sphere at a place: of what comes after it in its own cell, of the thirteen cells
/// of its level that come after that one, and of all 27 of each coarser level whose box it meets; so each
/// pair is met once. Tells the sink, sink.asks(own) and then sink.near(search, level, sets), by all threads
/// of a warp together, `sets` an array of PlaceSet; it asks met() of each in its own time. A sink that
/// `listens`, which only one on the host does, is also told of each cell that a sphere looks into,
/// sink.looks(i, level, bits), bit 3 r + 1 + x for that x further on in row r, and of each sphere it is
/// compared with, sink.compared(i, j, level).
template <class Tests, bool equal_radii, class Sink>
class CellSearch {
 public:
  CATENA_HD CellSearch(const ChainView& chain, const SphereCells& cells, const CellTable& table, Sink& sink)
      : chain_(chain), cells_(cells), placed_(cells), table_(table), sink_(sink) {}

  /// All threads of a warp come to these two together; one that is not `live` has no place, and any for
  /// `place` will do. This one is for spheres in one level, the other for those sorted by octaves.
  CATENA_HD void run_in_one_level(const PlacedSphere& own, std::uint32_t place, bool live) const {
    sink_.asks(own);
    look<own_row>({own, place, 0, 0, live});
  }
  CATENA_HD void run(const PlacedSphere& own, std::uint32_t place, bool live) const {
    sink_.asks(own);
    const std::uint32_t octave = cells_.octaves.of(own.sphere.radius);
    for (std::uint32_t word = 0; word < Octaves::count / 32; ++word) {
      const std::uint32_t levels = cells_.state->levels[word];
      if (levels == 0) continue;
      if constexpr (listens) tell_levels(word, levels, own, octave);
      const std::uint32_t met = live ? levels_near(cells_, word, levels, own.sphere, octave) : 0;
      for (std::uint32_t k = 0; k < 32 && levels >> k != 0; ++k) {
        const bool meets = (met >> k & 1) != 0;
        if (sink_.any(meets)) look<0>({own, place, octave, word * 32 + k, meets});
      }
    }
  }

  /// Of a sphere and what is at a place, in a cell of that level, which they are and whether they collide.
  /// Neighbours are known first: where tubes are drawn tightest they touch to the last bit, and that is the
  /// dearest to decide.
  CATENA_HD Met met(const PlacedSphere& own, std::uint32_t at, std::uint32_t level) const {
    const Sphere a = placed_.sphere(own.sphere);
    const PlacedSphere b = placed_.at(at);
    const bool of_level = equal_radii || cells_.one_level() || cells_.octaves.of(b.sphere.radius) == level,
               excluded = chain_.exclusion.neighbours(own.index, b.index, a.radius, b.sphere.radius);
    return {own.index, b.index, Tests::overlap_unless(!of_level || excluded, a, b.sphere)};
  }

 private:
  static constexpr std::uint32_t own_row = 4, rows = 9;

  /// One sphere that looks into one level.
  struct Look {
    const PlacedSphere& own;
    std::uint32_t place, octave, level;
    bool live;
    CATENA_HD bool in_own_level() const { return octave == level; }
  };
  /// That sphere's cell there, and the square of how far it reaches, in cells.
  struct Cell {
    PointCell at;
    std::uint32_t bucket;
    float limit;
    CATENA_HD Cell(const CellSearch& search, const Look& of)
        : at(search.cells_.cell(of.own.sphere, of.level)), bucket(search.table_.bucket(at, of.level)) {
      const float reach = search.cells_.reach(of.own.sphere, of.level);
      limit = reach * reach + 0x1p-20f;
    }
  };
  /// Cells next to one another along x.
  struct Row {
    std::uint32_t from, cells;
  };

  /// Of these levels those as coarse as the octave, or coarser, whose box the sphere meets, and which have
  /// others near it; out of line, so that this takes no registers from what follows.
  CATENA_COLD static std::uint32_t levels_near(const SphereCells& cells, std::uint32_t word,
                                               std::uint32_t levels, Sphere own, std::uint32_t octave) {
    const LevelBox::Facing box(Box::around(own));
    std::uint32_t near = 0;
    for (std::uint32_t left = levels; left != 0; left &= left - 1) {
      const std::uint32_t k = lowest_bit(left), level = word * 32 + k;
      if (level > octave) break;
      const bool looks = cells.state->box[level].meets(box) &&
                         (level == octave || cells.map.any_near(cells.cell(own, level), level));
      near |= static_cast<std::uint32_t>(looks) << k;
    }
    return near;
  }
  /// Into those whose box it does not meet it would have looked in vain; of those with nobody near there is
  /// nobody to tell of.
  void tell_levels(std::uint32_t word, std::uint32_t levels, const PlacedSphere& own,
                   std::uint32_t octave) const {
    const LevelBox::Facing box(Box::around(own.sphere));
    for (; levels != 0; levels &= levels - 1)
      if (const std::uint32_t level = word * 32 + lowest_bit(levels);
          level <= octave && !cells_.state->box[level].meets(box))
        sink_.looks(own.index, level, 0);
  }

  template <std::uint32_t first_row>
  CATENA_HD void look(const Look& of) const {
    const Cell cell(*this, of);
    Buckets::Run run[rows - first_row];  // all asked for before the first is waited for
    std::uint32_t longer = 0;
    sink_.converge();
    for (std::uint32_t r = first_row; r < rows; ++r) {
      Row row = this->row(r, of, cell);
      if constexpr (listens) tell_looks(r, of, cell, row);
      run[r - first_row] = {0, 0};
      if (row.cells > 0) run[r - first_row] = take(r, of, row);
      longer |= static_cast<std::uint32_t>(row.cells > 0) << r;
    }
    PlaceSet found[rows - first_row];
    for (std::uint32_t k = 0; k < rows - first_row; ++k) {
      longer |= static_cast<std::uint32_t>(run[k].end - run[k].first > batch) << (k + first_row);
      found[k] = near(of, run[k]);
    }
    sink_.near(*this, of.level, found);
    if (sink_.any(longer != 0)) look_further(longer, of);
  }

  /// What those rows have beyond the first places side by side, and beyond the first batch of these. Seldom:
  /// what is known of the cell is computed anew, so that it takes up no registers until then.
  CATENA_HD void look_further(std::uint32_t longer, const Look& of) const {
    const Cell cell(*this, of);
    Row row{0, 0};
    Buckets::Run run{0, 0};
    for (;;) {
      while (run.first >= run.end && (row.cells > 0 || longer != 0)) {
        if (row.cells > 0) {
          run = cells_.buckets.take(table_, row.from, row.cells);
        } else {
          const std::uint32_t r = lowest_bit(longer);
          longer &= longer - 1;
          row = this->row(r, of, cell);
          run = take(r, of, row);
          run.first += batch;
        }
      }
      const bool more = run.first < run.end;
      sink_.converge();
      if (!sink_.any(more)) return;
      const PlaceSet found[] = {more ? near(of, run) : PlaceSet{0, 0}};
      sink_.near(*this, of.level, found);
      run.first += batch;
    }
  }

  /// The cells of a row that the sphere can reach, of the three next to its own: those whose square of the
  /// distance, in cells, is at most `limit`, above which there is nothing it overlaps
  /// (properties/proofs/cell_rows.g).
  CATENA_HD Row row(std::uint32_t r, const Look& of, const Cell& cell) const {
    const auto& [at, bucket, limit] = cell;
    const float y = gap(at.y, r % 3), z = gap(at.z, r / 3), off = y * y + z * z;
    if (!of.live || off > limit || (of.in_own_level() && r < own_row)) return {0, 0};
    const bool left = !starts_at_itself(r, of) && reaches(at.x.below, off, limit);
    const std::uint32_t middle = table_.on(bucket, table_.step[r]);
    return {left ? table_.before(middle) : middle,
            1u + (left ? 1 : 0) + (reaches(at.x.above, off, limit) ? 1 : 0)};
  }
  CATENA_HD static bool starts_at_itself(std::uint32_t r, const Look& of) {
    return r == own_row && of.in_own_level();
  }
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

  /// Of the first `batch` of these places those whose spheres are not separate for certain from the looking
  /// one.
  CATENA_HD PlaceSet near(const Look& of, const Buckets::Run& run) const {
    const Sphere s = placed_.sphere(of.own.sphere);
    std::uint32_t bits = 0, end = run.end, at = run.first;
    if (end > run.first + batch) end = run.first + batch;
    if constexpr (listens)
      for (std::uint32_t j = run.first; j < end; ++j)
        sink_.compared(of.own.index, placed_.index(j), of.level);
#ifdef __CUDA_ARCH__
#pragma unroll 1  // else the threads of a warp, whose runs differ, would take turns
#endif
    for (; at < end; at += SphereCells::at_once) {
      const Sphere* const these = cells_.sphere + at;
      for (std::uint32_t k = 0; k < SphereCells::at_once; ++k)
        bits = with_sign(bits, Tests::excess(s, placed_.sphere(these[k])));
    }
    // What was read behind the last one is lowest, and shifted out.
    return {end - batch, at > end ? bits >> (at - end) : bits};
  }

  static constexpr bool listens = requires(Sink sink) { sink.compared(0u, 0u, 0u); };
  void tell_looks(std::uint32_t r, const Look& of, const Cell& cell, const Row& row) const {
    const bool left = row.from != table_.on(cell.bucket, table_.step[r]);
    const std::uint32_t cells = (1u << row.cells) - 1;  // the middle one is the second of three
    sink_.looks(of.own.index, of.level, (left ? cells : cells << 1) << (3 * r));
  }

  const ChainView& chain_;
  const SphereCells& cells_;
  const PlacedSpheres<equal_radii> placed_;
  const CellTable& table_;
  Sink& sink_;
};

}  // namespace catena
