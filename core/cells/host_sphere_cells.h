#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/cells/cells_evidence.h"
#include "catena/core/cells/host_buckets.h"
#include "catena/core/cells/search_cells.h"
#include "catena/core/executor/pair_collector.h"

namespace catena {

/// SphereCells on the host, its steps run one after the other: the device's twin. Keeps its memory.
class HostSphereCells {
 public:
  /// Sorts those spheres i of the chain for which takes(i), at most `expected` by a guess of the device.
  template <class Takes>
  void build(const ChainView& chain, std::uint32_t expected, const Takes& takes) {
    cells_ = SphereCells::of(chain.extent);
    table_ = cells_.table_for(expected);
    state_ = {};
    cells_.buckets = buckets_.reserve(table_, chain.size);
    index_.resize(chain.size);
    sphere_.resize(chain.size + std::size_t{SphereCells::at_once});
    cells_.index = index_.data(), cells_.sphere = sphere_.data(), cells_.state = &state_;
    for (std::uint32_t i = 0; i < chain.size; ++i)
      if (takes(i)) cells_.enter(table_, chain.spheres[i], i, 0);
    state_.together = buckets_.allocate();
    state_.places[0] = buckets_.places();
    if (!cells_.octaves.one && cells_.many_together()) sort_by_octaves(chain, takes);
    for (std::uint32_t i = 0; i < chain.size; ++i)
      if (takes(i)) cells_.place(table_, chain.spheres[i], i);
  }

  /// Every pair of those that were sorted.
  template <class Tests, class Sink>
  void search(const ChainView& chain, Sink& sink) const {
    cells_.octaves.equal ? search_all<Tests, true>(chain, sink) : search_all<Tests, false>(chain, sink);
  }

  /// Those that were sorted, as evidence names their cells; ids are first_id and following.
  CellsTrees trees(const ChainView& chain, std::uint32_t first_id) const {
    std::vector<std::uint32_t> spheres;
    for (std::uint32_t place = 0; place < buckets_.places(); ++place)
      spheres.push_back(cells_.octaves.equal ? PlacedSpheres<true>(cells_).index(place)
                                             : cells_.index[place]);
    return CellsTrees(chain, cells_, spheres, first_id);
  }

 private:
  template <class Tests, bool equal_radii, class Sink>
  void search_all(const ChainView& chain, Sink& sink) const {
    const CellSearch<Tests, equal_radii, Sink> search(chain, cells_, table_, sink);
    const PlacedSpheres<equal_radii> placed(cells_);
    for (std::uint32_t place = 0; place < buckets_.places() && !sink.satisfied(); ++place)
      cells_.one_level() ? search.run_in_one_level(placed.sphere(place), place, true)
                         : search.run(placed.sphere(place), place, true);
  }
  template <class Takes>
  void sort_by_octaves(const ChainView& chain, const Takes& takes) {
    cells_.buckets = buckets_.reserve(table_, chain.size);
    state_.by_octaves = 1;
    for (std::uint32_t i = 0; i < chain.size; ++i) {
      if (!takes(i)) continue;
      const std::uint32_t octave = cells_.octaves.of(chain.spheres[i].radius);
      cells_.enter(table_, chain.spheres[i], i, octave);
      state_.levels[octave / 32] |= 1u << octave % 32;
    }
    buckets_.allocate();
    state_.places[1] = buckets_.places();
  }

  SphereCells cells_{};
  CellTable table_{};
  SphereCells::State state_{};
  HostBuckets buckets_;
  std::vector<std::uint32_t> index_;
  std::vector<Sphere> sphere_;
};

/// A lane of a PairCollector as the sink of these searches.
struct LaneSink {
  PairCollector::Lane& lane;
  template <class Search, std::size_t sets>
  void near(const Search& search, std::uint32_t place, std::uint32_t level, const PlaceSet (&near)[sets]) {
    for (const PlaceSet& set : near) near_too(search, place, level, set);
  }
  template <class Search>
  void near_too(const Search& search, std::uint32_t place, std::uint32_t level, PlaceSet set) {
    for (; set.bits != 0; set.bits &= set.bits - 1) {
      const std::uint32_t at = set.first + lowest_bit(set.bits);
      if (search.collides(place, at, level)) pair_of(search.sphere_at(place), search.sphere_at(at));
    }
  }
  void pair(std::uint32_t i, std::uint32_t j) { lane.collide(i, j); }
  bool satisfied() const { return lane.satisfied(); }
  void converge() const {}
  bool any(bool own) const { return own; }

 private:
  void pair_of(std::uint32_t a, std::uint32_t b) { a < b ? pair(a, b) : pair(b, a); }
};

/// One that tells of the search.
struct TellingLane : LaneSink {
  CellsEvidence& evidence;
  void looks(std::uint32_t i, std::uint32_t level, std::uint32_t cells) { evidence.looks(i, level, cells); }
  void compared(std::uint32_t i, std::uint32_t j, std::uint32_t level) { evidence.compared(i, j, level); }
};

}  // namespace catena
