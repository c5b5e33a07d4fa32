#pragma once
#include <cstdint>
#include <stdexcept>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// A variant that is complete in itself and runs on the host: what such ones have in common. It times both
/// stages, refuses a find on another chain than that of the last build, and gathers the pairs.
class HostSearch : public Variant {
 public:
  void build(const Chain& chain) final {
    make(chain, [&] { construct(chain.view()); });
  }
  void update(const Chain& chain, const Moved&) final {
    const bool same_spheres = built_ && chain.size() == spheres_;
    make(chain, [&] { same_spheres ? construct_again(chain.view()) : construct(chain.view()); });
  }

  void find(const Chain& chain, const Request& request, Collisions& result) final {
    check(chain);
    const Stopwatch watch;
    PairCollector collector(spheres_, request, result, team(), lane_counts_);
    search(chain.view(), collector);
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) final {
    check(chain);
    const Stopwatch watch;
    PairCollector collector(spheres_, request, result);
    search_with_evidence(chain.view(), collector.lane(0), sink);
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  Timings timings() const final { return timings_; }

  Plan plan() const final { return built_ ? steps() : Plan(); }

 protected:
  /// Of what is built and was found in it; a build that failed may leave parts that are not of one chain.
  virtual Plan steps() const { return {}; }
  /// Makes what `search` needs. What it throws leaves nothing built.
  virtual void construct(const ChainView& chain) = 0;
  /// The same for the spheres of the last one, moved; what that left may be of use.
  virtual void construct_again(const ChainView& chain) { construct(chain); }
  /// Reports every colliding pair, once, to the collector's lanes.
  virtual void search(const ChainView& chain, PairCollector& collector) = 0;
  /// The same to one lane, by the caller alone, and to the sink what was left out; where evidence() says that
  /// there is some.
  virtual void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) {
    static_cast<void>(chain), static_cast<void>(lane), static_cast<void>(sink);
    throw std::logic_error("find_with_evidence: this variant has no evidence");
  }
  /// Who searches; each member has a lane.
  virtual const Team& team() const { return alone_; }

  bool built() const { return built_; }

 private:
  template <class Construct>
  void make(const Chain& chain, const Construct& construct) {
    const Stopwatch watch;
    built_ = false;
    construct();
    spheres_ = chain.size();
    built_ = true;
    timings_.build_ms = watch.ms();
  }
  void check(const Chain& chain) const {
    if (!built_ || chain.size() != spheres_) throw std::logic_error("find: not the chain of the last build");
  }

  const Team alone_;
  std::uint32_t spheres_ = 0;
  bool built_ = false;
  Timings timings_;
  std::vector<LaneCounts> lane_counts_;  ///< [member of the team]
};

}  // namespace catena
