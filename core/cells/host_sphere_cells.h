#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/cells/cells_evidence.h"
#include "catena/core/cells/host_buckets.h"
#include "catena/core/cells/search_cells.h"
#include "catena/core/executor/pair_collector.h"

namespace catena {

/// SphereCells in host memory whose spheres have their places.
struct PlacedCells {
  SphereCells cells{};
  CellTable table{};

  /// Every pair of those that were sorted.
  template <class Tests, class Sink>
  void search(const ChainView& chain, Sink& sink) const {
    cells.octaves.equal ? search_all<Tests, true>(chain, sink) : search_all<Tests, false>(chain, sink);
  }
  /// They, as evidence names their cells; ids are first_id and following.
  CellsTrees trees(const ChainView& chain, std::uint32_t first_id) const {
    std::vector<std::uint32_t> spheres(cells.places());
    for (std::uint32_t place = 0; place < spheres.size(); ++place)
      spheres[place] = cells.octaves.equal ? PlacedSpheres<true>(cells).index(place) : cells.index[place];
    return CellsTrees(chain, cells, spheres, first_id);
  }

 private:
  template <class Tests, bool equal_radii, class Sink>
  void search_all(const ChainView& chain, Sink& sink) const {
    const CellSearch<Tests, equal_radii, Sink> search(chain, cells, table, sink);
    const PlacedSpheres<equal_radii> placed(cells);
    for (std::uint32_t place = 0; place < cells.places() && !sink.satisfied(); ++place)
      cells.one_level() ? search.run_in_one_level(placed.at(place), place, true)
                        : search.run(placed.at(place), place, true);
  }
};

/// SphereCells on the host, its steps run one after the other: the device's twin. Keeps its memory.
class HostSphereCells {
 public:
  /// Sorts those spheres i of the chain for which takes(i), at most `expected` by a guess of the device.
  template <class Takes>
  void build(const ChainView& chain, std::uint32_t expected, const Takes& takes) {
    auto& [cells, table] = placed_;
    cells = SphereCells::of(chain.extent);
    table = cells.table_for(expected);
    state_ = {};
    cells.buckets = buckets_.reserve(table, chain.size);
    index_.resize(chain.size);
    sphere_.resize(chain.size + std::size_t{SphereCells::at_once});
    cells.index = index_.data(), cells.sphere = sphere_.data(), cells.state = &state_;
    for (std::uint32_t i = 0; i < chain.size; ++i)
      if (takes(i)) cells.enter(table, chain.spheres[i], i);
    state_.together = buckets_.allocate();
    state_.places[0] = buckets_.places();
    if (!cells.octaves.one && cells.many_together()) sort_by_octaves(chain, takes);
    for (std::uint32_t i = 0; i < chain.size; ++i)
      if (takes(i)) cells.place(table, chain.spheres[i], i);
  }

  const PlacedCells& placed() const { return placed_; }

 private:
  template <class Takes>
  void sort_by_octaves(const ChainView& chain, const Takes& takes) {
    auto& [cells, table] = placed_;
    cells.buckets = buckets_.reserve(table, chain.size);
    cells.map = LevelMap::of(chain.size);
    map_.assign(cells.map.words(), 0);
    cells.map.word = map_.data();
    state_.by_octaves = 1;
    for (std::uint32_t i = 0; i < chain.size; ++i) {
      if (!takes(i)) continue;
      const std::uint32_t octave = cells.octaves.of(chain.spheres[i].radius);
      cells.enter_octave(table, chain.spheres[i], i, octave);
      state_.levels[octave / 32] |= 1u << octave % 32;
      state_.box[octave].join(LevelBox::Ends(Box::around(chain.spheres[i])));
    }
    buckets_.allocate();
    state_.places[1] = buckets_.places();
  }

  PlacedCells placed_;
  SphereCells::State state_{};
  HostBuckets buckets_;
  std::vector<std::uint32_t> index_, map_;
  std::vector<Sphere> sphere_;
};

/// A lane of a PairCollector as the sink of these searches.
struct LaneSink {
  PairCollector::Lane& lane;
  PlacedSphere asking{};  ///< as the search says
  void asks(const PlacedSphere& own) { asking = own; }
  template <class Search, std::size_t sets>
  void near(const Search& search, std::uint32_t level, const PlaceSet (&near)[sets]) {
    for (PlaceSet set : near)
      while (set.bits != 0) near_one(search, level, set.take(), true);
  }
  template <class Search>
  void near_one(const Search& search, std::uint32_t level, std::uint32_t at, bool is_near) {
    if (!is_near) return;
    if (const Met met = search.met(asking, at, level); met.collide)
      collide(met.i < met.j ? Pair{met.i, met.j} : Pair{met.j, met.i});
  }
  template <class PairOf>
  void collide(std::uint32_t lanes, const PairOf& pair) {
    for (; lanes != 0; lanes &= lanes - 1) collide(pair(lowest_bit(lanes)));
  }
  void count(std::uint32_t, std::uint32_t) const {}  // collide() counts
  bool satisfied() const { return lane.satisfied(); }
  void converge() const {}
  bool any(bool own) const { return own; }

 private:
  void collide(const Pair& pair) { lane.collide(pair.i, pair.j); }
};

}  // namespace catena
