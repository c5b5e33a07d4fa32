#include "catena/properties/mutants/faulty_parts.h"
#include "catena/properties/mutants/mutant.h"

// Bugs of searches part after part, as of domain decompositions everywhere: what a part borrows of its
// neighbours is short by something, or what two parts find is counted twice.
namespace catena::properties {
namespace {

using parts::LocalChain;
using parts::PartRanges;

/// The halo ends a sphere too soon.
class ShortHalo final : public FaultyParts {
  void spoil(PartRanges& ranges) override {
    if (!ranges.after.empty()) --ranges.after.back().end;
  }
};
const RegisterMutant<ShortHalo> shortened{"halo-one-short", "a domain borrows one sphere too few",
                                          FaultyParts::parameters()};

class NoHalo final : public FaultyParts {
  void spoil(PartRanges& ranges) override { ranges.after.clear(), ranges.before.clear(); }
};
const RegisterMutant<NoHalo> none{"parts-forget-what-is-between", "each part is searched for itself alone",
                                  FaultyParts::parameters()};

/// A pair of two parts is found by both.
class BothFind final : public FaultyParts {
  SphereRange asked(const LocalChain& part) override { return {0, part.size()}; }
};
const RegisterMutant<BothFind> both{"pairs-of-two-parts-twice", "what is borrowed is counted as own",
                                    FaultyParts::parameters()};

/// Spheres next to each other on the tube, in two pieces of a part, collide.
class PiecesAreStrangers final : public FaultyParts {
  parts::Order order() const override { return parts::Order::space; }
  Chain spoiled(Chain part) override {
    if (part.exclusion().rule != Exclusion::Rule::index_window) return part;
    Exclusion exclusion = part.exclusion();
    exclusion.extra_pairs.clear();
    return Chain({part.spheres().begin(), part.spheres().end()}, part.strands(), std::move(exclusion));
  }
};
const RegisterMutant<PiecesAreStrangers> strangers{"neighbours-across-pieces-forgotten",
                                                   "a strand that was cut at the border of a part",
                                                   FaultyParts::parameters()};

}  // namespace
}  // namespace catena::properties
