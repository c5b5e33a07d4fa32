#pragma once
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

  /// All threads of a warp come here together; one that is not `live` has no place, and any for `place` will do.
  CATENA_HD void run(std::uint32_t place, bool live) const {
    const Sphere s = cells_.sphere[place];
    if (cells_.octaves.one) return look({s, place, 0, 0, live});
    const std::uint32_t octave = cells_.octaves.of(s.radius);
    for (std::uint32_t word = 0; word < Octaves::count / 32; ++word) {
      const std::uint32_t levels = cells_.state->levels[word];
      for (std::uint32_t level = word * 32; levels >> level % 32 != 0; ++level) {
        if (levels >> level % 32 & 1) look({s, place, octave, level, live && level <= octave});
        if (level % 32 == 31) break;
      }
    }
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
    for (std::uint32_t r = cells_.octaves.one ? own_row : 0; r < rows; ++r) row(r, of, at, bucket);
  }

  /// The cells of a row that the sphere can reach, of the three next to its own: what it overlaps lies less than one
  /// cell away, by so much that no rounding of these distances matters (properties/proofs/grid_cells.g).
  CATENA_HD void row(std::uint32_t r, const Look& of, const PointCell& at, std::uint32_t bucket) const {
    const float y = gap(at.y, r % 3), z = gap(at.z, r / 3), off = y * y + z * z;
    const bool first_half = of.own() && r < own_row, in_own = of.own() && r == own_row;
    std::uint32_t first = 0, end = 0;
    bool cut = false;
    if (of.live && off <= 1 && !first_half) {
      const std::uint32_t left = !in_own && reaches(at.x.below, off) ? 1 : 0, right = reaches(at.x.above, off) ? 1 : 0;
      const std::uint32_t middle = table_.on(bucket, table_.step[r]);
      const std::uint32_t from = left ? table_.before(middle) : middle, cells = 1 + left + right;
      cut = from % SphereCells::chunk + cells > SphereCells::chunk || from + cells > table_.buckets;
      if (cut) {
        cut_row(of, from, cells, in_own);
      } else {
        const std::uint32_t* const start = cells_.start + SphereCells::start_of(from);
        first = in_own ? of.place + 1 : start[0];
        end = start[cells];
      }
    }
    sink_.converge();
    meet(of, first, end);
  }
  CATENA_HD static float gap(const AxisCell& at, std::uint32_t way) {
    return way == 0 ? at.below : way == 2 ? at.above : 0;
  }
  CATENA_HD static bool reaches(float along, float off) { return along * along + off <= 1; }

  /// A row that goes on in another chunk or at the table's begin.
  CATENA_COLD void cut_row(const Look& of, std::uint32_t bucket, std::uint32_t cells, bool own) const {
    for (; cells > 0; --cells, bucket = table_.on(bucket, 1), own = false) {
      const std::uint32_t* const start = cells_.start + SphereCells::start_of(bucket);
      for (std::uint32_t at = own ? of.place + 1 : start[0]; at < start[1]; ++at) met(of, at);
    }
  }

  /// First who is near, without calls or rare branches, so that the threads of a warp stay together; then those.
  CATENA_HD void meet(const Look& of, std::uint32_t first, std::uint32_t end) const {
    std::uint32_t bits = near(of.sphere, first, end);
    sink_.converge();
    do {
      for (std::uint32_t at = first; bits != 0; ++at, bits >>= 1)
        if (bits & 1) met(of, at);
      first += batch;
      if (first < end) bits = near(of.sphere, first, end);
    } while (first < end);
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

  CATENA_HD void met(const Look& of, std::uint32_t at) const {
    const Sphere other = cells_.sphere[at];
    if (!Tests::overlap(of.sphere, other) || cells_.octaves.of(other.radius) != of.level) return;
    const std::uint32_t a = cells_.index[of.place], b = cells_.index[at], i = a < b ? a : b, j = a < b ? b : a;
    if (!chain_.neighbours(i, j)) sink_.pair(i, j);
  }

  const ChainView& chain_;
  const SphereCells& cells_;
  const CellTable& table_;
  Sink& sink_;
};

}  // namespace catena
