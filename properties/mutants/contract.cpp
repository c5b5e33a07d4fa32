#include <algorithm>

#include "catena/core/arithmetic/robust.h"
#include "catena/properties/mutants/mutant.h"

// Bugs in what a search is asked, and in what it says of itself.
namespace catena::properties {
namespace {

/// Searches the chain that was built last, whichever it is given.
class LastChain final : public FaultyTree {
  void build(const Chain& chain) override {
    last_ = chain;
    FaultyTree::build(last_);
  }
  void find(const Chain&, const Request& request, Collisions& result) override {
    FaultyTree::find(last_, request, result);
  }
  Chain last_;
};
const RegisterMutant<LastChain> last{"finds-on-the-last-chain",
                                     "catena's own GPU1: a search without a build answered for any chain"};

/// The last sphere of a range counts as asked about twice, by its own part and by the one before.
class RangeOffByOne final : public FaultyTree {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    Request wider = request;
    if (wider.queries.end < chain.size()) ++wider.queries.end;
    FaultyTree::find(chain, wider, result);
  }
};
const RegisterMutant<RangeOffByOne> range{"query-range-off-by-one", "an end that counts as in"};

/// Remembers what was asked for before the build for ever.
class AskedOnce final : public FaultyTree {
  void prepare(const Request& request) override {
    if (asked_) return;
    asked_ = true;
    want_ = request.want;
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    FaultyTree::find(chain, request, result);
    if (asked_ && want_ == Request::Want::any) result.pairs.clear();
  }
  bool asked_ = false;
  Request::Want want_ = Request::Want::pairs;
};
const RegisterMutant<AskedOnce> asked{"prepared-once",
                                      "what is left out of the first build is left out of all"};

/// Updates only what it is told has moved, and of each stretch not the last sphere.
class StretchTooShort final : public FaultyTree {
  void update(const Chain& chain, const Moved& moved) override {
    if (moved.everything() || chain.size() != tree().leaves) return build(chain);
    std::vector<Sphere> spheres(tree().bound, tree().bound + tree().leaves);
    for (const SphereRange& part : moved.ranges())
      std::copy(chain.spheres().begin() + part.begin, chain.spheres().begin() + part.end - 1,
                spheres.begin() + part.begin);
    std::ranges::copy(spheres, tree().bound);
    construct();
  }
};
const RegisterMutant<StretchTooShort> stretch{"moved-range-off-by-one",
                                              "the last sphere of a moved stretch stays"};

/// A right search with evidence: each sphere against the tree.
class Witness : public FaultyTree {
 public:
  using Base = Witness;
  Accounting evidence() const override { return Accounting::from_both_ends; }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    FaultyTree::find(chain, request, result);
    for (std::uint32_t i = 0; i < chain.size(); ++i) tell(chain, i, tree().root, sink);
  }

 protected:
  virtual void tell(const Chain& chain, std::uint32_t i, std::uint32_t slot, EvidenceSink& sink) const {
    if (tree().is_leaf(slot)) {
      if (slot != i) chain.neighbours(i, slot) ? sink.excluded(i, slot) : sink.tested(i, slot);
    } else if (!Robust::may_overlap(tree().bound[i], tree().bound[slot])) {
      sink.discarded(i, slot);
    } else {
      tell(chain, i, tree().links[slot].left, sink);
      tell(chain, i, tree().links[slot].right, sink);
    }
  }
};

/// Says of a subtree that it was left out where it was searched.
class DiscardsTouching final : public Witness {
  void tell(const Chain& chain, std::uint32_t i, std::uint32_t slot, EvidenceSink& sink) const override {
    if (slot != i && slot >= tree().leaves && i % 7 == 3) return sink.discarded(i, slot);
    Witness::tell(chain, i, slot, sink);
  }
};
const RegisterMutant<DiscardsTouching> discards{"evidence-discards-what-overlaps",
                                                "a certificate that does not say what was done"};

/// The search that is proved is not the one that users run.
class UnlikeItsEvidence final : public Witness {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    FaultyTree::find(chain, request, result);
    if (result.pairs.empty()) return;
    const Pair lost = result.pairs.back();
    result.pairs.pop_back();
    --result.pair_count, --result.count[lost.i], --result.count[lost.j];
  }
};
const RegisterMutant<UnlikeItsEvidence> unlike{"find-unlike-its-evidence",
                                               "catena's own verify --certify: find() was never called"};

/// Lends a pair to the sink, and gets it back when the search is done, if it is.
class LendsToASink final : public Witness {
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    FaultyTree::find(chain, request, result);
    if (!lent_ || result.pairs.empty()) return;
    const Pair lost = result.pairs.back();
    result.pairs.pop_back();
    --result.pair_count, --result.count[lost.i], --result.count[lost.j];
    result.found = result.pair_count > 0;
  }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    lent_ = true;
    Witness::find_with_evidence(chain, request, result, sink);
    lent_ = false;
  }
  bool lent_ = false;
};
const RegisterMutant<LendsToASink> lends{"evidence-lost-to-a-sink-that-throws",
                                         "parts that a search without room left half shared out"};

}  // namespace
}  // namespace catena::properties
