#include <cstdint>
#include <numeric>
#include <vector>

#include "catena/properties/mutants/faulty_hybrid.h"

// Bugs of a search in parts: what one hands to another that does not take it.
namespace catena::properties {
namespace {

/// What is crowded goes by cells or the order of space, whichever is cheaper.
class Crowded : public FaultyHybrid {
 public:
  using Base = Crowded;
  Crowded() : FaultyHybrid({16, 1}) {}
};

/// All is dense, and in cells whatever is near it.
class InCells : public FaultyHybrid {
 public:
  using Base = InCells;
  explicit InCells(float doubt = 1) : FaultyHybrid({0, 0, true, doubt}) {}

 protected:
  void tamper(const ChainView& chain, Parts& parts) override {
    if (parts.dense_count < chain.size || chain.size == 0 || parts.in_cells) return;
    build_grid(chain, parts.grid, {}, Team());
    parts.in_cells = true;
  }
};

/// A node goes over to the search in space after what is crowded was sorted.
class LateCrowd final : public Crowded {
  void tamper(const ChainView&, Parts& parts) override {
    for (std::uint32_t node = parts.crowding.nodes(); node-- > 0;)
      if (!parts.crowding.crowded(node)) return parts.crowding.crowd(node);
  }
};
const RegisterMutant<LateCrowd> late{"crowd-handed-to-no-one",
                                     "a crowded part that the search which takes them has not heard of"};

/// The last pair of nodes that met is lost.
class LastRowLost final : public Crowded {
  void tamper(const ChainView&, Parts& parts) override {
    for (auto& pairs : parts.crowding.pairs())
      if (!pairs.empty()) pairs.pop_back();
  }
};
const RegisterMutant<LastRowLost> row{"queue-drops-its-last", "a queue emptied one short"};

/// All are dense, and the cells get all but a few.
class FewTooFew final : public InCells {
  void tamper(const ChainView& chain, Parts& parts) override {
    if (parts.dense_count < chain.size || chain.size < 2 * few) return;
    std::vector<std::uint32_t> all(chain.size - few);
    std::iota(all.begin(), all.end(), 0u);
    build_grid(chain, parts.grid, all, Team());
    parts.in_cells = true;
  }
  static constexpr std::uint32_t few = BlockTree::block;
};
const RegisterMutant<FewTooFew> few{"last-dense-block-not-in-cells",
                                    "a list of what is dense that is one block short"};

/// Takes binary32 at its word within the band of rounding too.
constexpr float trusting = 1 - 0x1p-20f;

class TrustsBlocks final : public FaultyHybrid {
 public:
  TrustsBlocks() : FaultyHybrid({0, never, true, trusting}) {}
};
const RegisterMutant<TrustsBlocks> trusts_blocks{
    "exact-stage-left-out", "what is within rounding of touching decided without the exact stage, by blocks"};
class TrustsCells final : public InCells {
 public:
  TrustsCells() : InCells(trusting) {}
};
const RegisterMutant<TrustsCells> trusts_cells{
    "exact-stage-left-out-in-cells", "what is within rounding of touching decided without the exact stage"};

class OneRadius final : public InCells {
  void tamper(const ChainView& chain, Parts& parts) override {
    InCells::tamper(chain, parts);
    parts.grid.equal_radii = parts.grid.levels.size() == 1;  // as cells of one width suggest
  }
};
const RegisterMutant<OneRadius> one_radius{"radii-taken-for-equal",
                                           "one radius read for all where they differ a little"};

}  // namespace
}  // namespace catena::properties
