#pragma once
#include <cstdint>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/sphere_cells.h"

namespace catena {

/// Who may collide with the sphere at a place: of what comes after it in its own cell, of the thirteen cells
/// of its level that come after that one, and of all 27 of each coarser level; so each pair is met once.
/// Tells them to sink.near(search, place, at, level), which asks search.decide(place, at, level) of each in
/// its own time.
template <class Tests, class Sink>
class CellSearch {
 public:
  CATENA_HD CellSearch(const ChainView& chain, const SphereCells& cells, const CellTable& table, Sink& sink)
      : chain_(chain), cells_(cells), table_(table), sink_(sink) {}

  /// All threads of a warp come here together; one that is not `live` has no place, and any for `place` will
  /// do.
  CATENA_HD void run(const Sphere& s, std::uint32_t place, bool live) const {
    if (cells_.octaves.one) return look({s, place, 0, 0, live});
    const std::uint32_t octave = cells_.octaves.of(s.radius);
    for (std::uint32_t word = 0; word < Octaves::count / 32; ++word) {
      const std::uint32_t levels = cells_.state->levels[word];
      for (std::uint32_t level = word * 32; levels >> level % 32 != 0; ++level) {
        if ((levels >> level % 32 & 1) && sink_.any(live && level <= octave))
          look({s, place, octave, level, live && level <= octave});
        if (level % 32 == 31) break;
      }
    }
  }

  /// Whether the spheres at these places collide, the second in a cell of that level; if so, sink.pair(i, j),
  /// i < j.
  CATENA_HD void decide(std::uint32_t place, std::uint32_t at, std::uint32_t level) const {
    const Sphere s = cells_.sphere[place], other = cells_.sphere[at];
    if (!Tests::overlap(s, other) || cells_.octaves.of(other.radius) != level) return;
    const std::uint32_t a = cells_.index[place], b = cells_.index[at], i = a < b ? a : b, j = a < b ? b : a;
    if (!chain_.neighbours(i, j)) sink_.pair(i, j);
  }

 private:
  static constexpr std::uint32_t own_row = 4, rows = 9;

  /// One sphere that looks into one level.
  struct Look {
    Sphere sphere;
    std::uint32_t place, octave, level;
    bool live;
    CATENA_HD bool own() const { return octave == level; }
  };

  CATENA_HD void look(const Look& of) const {
    const PointCell at = cells_.cell(of.sphere, of.level);
    const std::uint32_t bucket = table_.bucket(at, of.level);
    const float reach = cells_.reach(of.sphere, of.level), limit = reach * reach + 0x1p-20f;
    for (std::uint32_t r = cells_.octaves.one ? own_row : 0; r < rows; ++r) row(r, of, at, bucket, limit);
  }

  /// The cells of a row that the sphere can reach, of the three next to its own: those whose square of the
  /// distance, in cells, is at most `limit`, above which there is nothing it overlaps
  /// (properties/proofs/cell_rows.g).
  CATENA_HD void row(std::uint32_t r, const Look& of, const PointCell& at, std::uint32_t bucket,
                     float limit) const {
    const float y = gap(at.y, r % 3), z = gap(at.z, r / 3), off = y * y + z * z;
    std::uint32_t from = bucket, cells = 0;
    bool own = of.own() && r == own_row;
    if (of.live && off <= limit && !(of.own() && r < own_row)) {
      const bool left = !own && reaches(at.x.below, off, limit);
      const std::uint32_t middle = table_.on(bucket, table_.step[r]);
      from = left ? table_.before(middle) : middle;
      cells = 1 + (left ? 1 : 0) + (reaches(at.x.above, off, limit) ? 1 : 0);
    }
    if (!sink_.any(cells > 0)) return;
    do {  // mostly once: a run of buckets may go on in another chunk, or at the table's begin
      std::uint32_t first = 0, end = 0;
      if (cells > 0) {
        const std::uint32_t of_chunk = SphereCells::chunk - from % SphereCells::chunk,
                            of_table = table_.buckets - from,
                            room = of_chunk < of_table ? of_chunk : of_table,
                            take = cells < room ? cells : room;
        const std::uint32_t* const start = cells_.start + SphereCells::start_of(from);
        first = own ? of.place + 1 : start[0];
        end = start[take];
        cells -= take;
        from = table_.on(from, take);
        own = false;
      }
      sink_.converge();
      meet(of, first, end);
    } while (sink_.any(cells > 0));
  }
  CATENA_HD static float gap(const AxisCell& at, std::uint32_t way) {
    return way == 0 ? at.below : way == 2 ? at.above : 0;
  }
  CATENA_HD static bool reaches(float along, float off, float limit) { return along * along + off <= limit; }

  /// First all comparisons, without calls or rare branches, so that the threads of a warp stay together.
  CATENA_HD void meet(const Look& of, std::uint32_t first, std::uint32_t end) const {
    std::uint32_t bits = near(of.sphere, first, end);
    sink_.converge();
    while (first < end) {
      for (; bits != 0; bits &= bits - 1) sink_.near(*this, of.place, first + lowest_bit(bits), of.level);
      first += batch;
      if (first < end) bits = near(of.sphere, first, end);
    }
    sink_.converge();
  }

  static constexpr std::uint32_t batch = 32, at_once = 4;

  /// Bit k: the sphere is not separate for certain from that at place first + k; of `batch` at most.
  CATENA_HD std::uint32_t near(const Sphere& s, std::uint32_t first, std::uint32_t end) const {
    std::uint32_t bits = 0;
    if (end > first + batch) end = first + batch;
    for (std::uint32_t at = first; at < end; at += at_once) {
      std::uint32_t of_these = 0;
      for (std::uint32_t k = 0; k < at_once; ++k) {
        const std::uint32_t place = at + k < end ? at + k : end - 1;
        of_these |= static_cast<std::uint32_t>(!Tests::separate(s, cells_.sphere[place])) << k;
      }
      bits |= of_these << (at - first);
    }
    return end - first < batch ? bits & ((1u << (end - first)) - 1) : bits;
  }

  const ChainView& chain_;
  const SphereCells& cells_;
  const CellTable& table_;
  Sink& sink_;
};

}  // namespace catena
