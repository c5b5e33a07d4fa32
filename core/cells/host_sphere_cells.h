#pragma once
#include <cstdint>
#include <vector>

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
    const std::uint32_t chunks = SphereCells::chunks(table_);
    count_.resize(chunks * std::size_t{SphereCells::chunk});
    start_.resize(SphereCells::starts(chunks));
    rank_.resize(chain.size);
    index_.resize(chain.size);
    sphere_.resize(chain.size);
    state_ = {};
    cells_.count = count_.data(), cells_.start = start_.data(), cells_.rank = rank_.data();
    cells_.index = index_.data(), cells_.sphere = sphere_.data(), cells_.state = &state_;
    for (std::uint32_t i = 0; i < chain.size; ++i)
      if (takes(i)) note(cells_.enter(table_, chain.spheres[i], i));
    for (std::uint32_t k = 0; k < chunks; ++k) allocate(k);
    for (std::uint32_t i = 0; i < chain.size; ++i)
      if (takes(i)) cells_.place(table_, chain.spheres[i], i);
    for (std::uint32_t place = 0; place < state_.places; ++place) cells_.fill(chain, place);
  }

  /// Every pair of those that were sorted.
  template <class Tests, class Sink>
  void search(const ChainView& chain, Sink& sink) const {
    const CellSearch<Tests, Sink> search(chain, cells_, table_, sink);
    for (std::uint32_t place = 0; place < state_.places && !sink.satisfied(); ++place)
      search.run(sphere_[place], place, true);
  }

 private:
  void note(std::uint32_t octave) { state_.levels[octave / 32] |= 1u << octave % 32; }

  void allocate(std::uint32_t chunk) {
    std::uint32_t* const start = start_.data() + SphereCells::starts(chunk);
    std::uint32_t* const count = count_.data() + chunk * std::size_t{SphereCells::chunk};
    for (std::uint32_t k = 0; k < SphereCells::chunk; ++k) {
      start[k] = state_.places;
      state_.places += count[k];
      count[k] = 0;
    }
    start[SphereCells::chunk] = state_.places;
  }

  SphereCells cells_{};
  CellTable table_{};
  SphereCells::State state_{};
  std::vector<std::uint32_t> count_, start_, rank_, index_;
  std::vector<Sphere> sphere_;
};

/// A lane of a PairCollector as the sink of these searches.
struct LaneSink {
  PairCollector::Lane& lane;
  template <class Search>
  void near(const Search& search, std::uint32_t place, std::uint32_t at, std::uint32_t level) {
    search.decide(place, at, level);
  }
  void pair(std::uint32_t i, std::uint32_t j) { lane.collide(i, j); }
  bool satisfied() const { return lane.satisfied(); }
  void converge() const {}
  bool any(bool own) const { return own; }
};

}  // namespace catena
