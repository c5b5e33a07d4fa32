#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "catena/core/error.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/register.h"

namespace catena::reference {

/// What every peer does with two spheres that its broad phase lets meet: the chain's rule and one exact test,
/// the same for all. So peers differ in their broad phases alone, and one is wrong where its broad phase
/// loses a pair or gives it twice.
class Candidates {
 public:
  Candidates(const ChainView& chain, PairCollector::Lane& lane) : chain_(chain), lane_(lane) {}
  void operator()(std::uint32_t a, std::uint32_t b) const {
    const auto [i, j] = std::minmax(a, b);
    if (!chain_.neighbours(i, j) && Robust::overlap(chain_.spheres[i], chain_.spheres[j]))
      lane_.collide(i, j);
  }
  bool enough() const { return lane_.satisfied(); }

 private:
  const ChainView& chain_;
  PairCollector::Lane& lane_;
};

/// Somebody else's broad phase as a variant, sequential.
class Peer : public Variant {
 public:
  void build(const Chain& chain) final {
    timed(chain, [&] { make(chain.view()); });
  }
  void update(const Chain& chain, const Moved&) final {
    if (spheres_ != chain.size()) return build(chain);
    timed(chain, [&] { move(chain.view()); });
  }

  void find(const Chain& chain, const Request& request, Collisions& result) final {
    if (spheres_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    const ChainView view = chain.view();
    PairCollector collector(view.size, request, result);
    if (view.size > 1) offer(view, Candidates(view, collector.lane(0)));
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  Timings timings() const final { return timings_; }

 private:
  virtual void make(const ChainView& chain) = 0;
  /// As many spheres as before, moved: what the library has for it.
  virtual void move(const ChainView& chain) { make(chain); }
  /// Offers every pair whose bounds meet, once, until there are enough; of two spheres at least.
  virtual void offer(const ChainView& chain, const Candidates& candidates) = 0;

  template <class Work>
  void timed(const Chain& chain, const Work& work) {
    const Stopwatch watch;
    spheres_.reset();
    work();
    spheres_ = chain.size();
    timings_.build_ms = watch.ms();
  }

  std::optional<std::uint32_t> spheres_;  ///< of the last build; nothing after one that threw
  Timings timings_;
};

struct PeerInfo {
  std::string name, summary;
  std::string broad_phase;  ///< how it computes: "binary32" or "binary64"
  std::string source;       ///< what a build without it lacks: the Debian package, or what to configure
};

/// A peer registers itself by one object of this ...
template <class Library>
struct RegisterPeer {
  explicit RegisterPeer(const PeerInfo& info) {
    StrategyRegistry::instance().add_variant({.name = info.name, .summary = info.summary, .peer = true},
                                             {.name = info.broad_phase, .exact = false},
                                             make_strategy<Library, Variant>);
  }
};

/// ... or of this where its library is not built in.
struct RegisterAbsentPeer {
  explicit RegisterAbsentPeer(const PeerInfo& info) {
    const std::string why = "catena was built without " + info.name + " (" + info.source + ")";
    StrategyRegistry::instance().add_variant(
        {.name = info.name,
         .summary = info.summary,
         .peer = true,
         .unavailable = [why] { return std::optional(why); }},
        {.name = info.broad_phase, .exact = false},
        [why](const Parameters&) -> std::unique_ptr<Variant> { throw CapacityError(why); });
  }
};

}  // namespace catena::reference
