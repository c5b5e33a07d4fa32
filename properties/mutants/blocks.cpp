#include <algorithm>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/executor/host_search.h"
#include "catena/properties/mutants/mutant.h"

// Bugs of searches by blocks of eight spheres: what a capsule, an order, a box or a queue may forget.
namespace catena::properties {
namespace {

/// ChainTree with its tree tampered with.
class FaultyBlocks : public HostSearch {
 public:
  using Base = FaultyBlocks;

 protected:
  void construct(const ChainView& chain) override {
    build_block_tree(chain, tree_, team());
    if (chain.size > 0) tamper(chain, tree_);  // else levels are of an earlier one
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    search_blocks(chain, tree_, queues_, collector.lane(0), nullptr);
  }
  virtual void tamper(const ChainView&, BlockTree&) {}
  const BlockTree& tree() const { return tree_; }
  std::span<BlockQueues> queues() { return {&queues_, 1}; }

 private:
  BlockTree tree_;
  BlockQueues queues_;
};

class NoSagitta final : public FaultyBlocks {
  void tamper(const ChainView& chain, BlockTree& tree) override {
    for (std::uint32_t b = 0; b < tree.blocks; ++b) {
      const Sphere* const s = tree.spheres(chain, b);
      float thickest = 0;
      for (std::uint32_t k = 0; k < tree.size_of(b); ++k) thickest = std::max(thickest, s[k].radius);
      tree.capsules_of(b / BlockTree::group)[6 * BlockTree::group + b % BlockTree::group] =
          thickest * tree.scale;
    }
  }
};
const RegisterMutant<NoSagitta> sagitta{"capsule-without-sagitta",
                                        "as thick as its spheres, wherever they lie"};

/// The last block of a strand goes on into the next strand, which its capsule was not made for.
class BlockReadsOn final : public FaultyBlocks {
  void tamper(const ChainView& chain, BlockTree& tree) override {
    for (std::uint32_t b = 0; b < tree.blocks; ++b)
      if (tree.begin_of(b) + BlockTree::block <= chain.size) tree.first[b] &= ~BlockTree::unfilled;
  }
};
const RegisterMutant<BlockReadsOn> reads_on{"block-that-reads-on",
                                            "eight spheres, whatever the strand has left"};

/// The last sphere of a strand is in no block.
class BlockOneShort final : public FaultyBlocks {
  void tamper(const ChainView&, BlockTree& tree) override {
    for (std::uint32_t b = 0; b < tree.blocks; ++b)
      if (tree.first[b] & BlockTree::unfilled) --tree.filled[b];
  }
};
const RegisterMutant<BlockOneShort> one_short{"block-one-short",
                                              "the last of what a strand has left is forgotten"};

/// What ends the chain is read one sphere too early.
class TailOffByOne final : public FaultyBlocks {
  void tamper(const ChainView&, BlockTree& tree) override {
    std::copy(tree.tail, tree.tail + 2 * BlockTree::block - 1, tree.tail + 1);
  }
};
const RegisterMutant<TailOffByOne> tail{"tail-off-by-one", "the last block reads one sphere too early"};

/// Calls order(spheres, window) for each window of two full blocks of one strand, and takes its word.
class FaultyOrder : public FaultyBlocks {
  void tamper(const ChainView& chain, BlockTree& tree) override {
    for (std::uint32_t b = 0; b + 1 < tree.blocks; ++b) {
      const std::uint32_t i = tree.first[b];
      if ((i & BlockTree::unfilled) != 0 || tree.first[b + 1] != i + BlockTree::block) continue;
      if (chain.strand_count > 1 &&
          chain.exclusion.strand_of[i] != chain.exclusion.strand_of[tree.first[b + 1]])
        continue;
      const auto bit = static_cast<std::uint16_t>(1u << b % BlockTree::group);
      if (ordered(chain.spheres + i)) tree.ordered[b / BlockTree::group] |= bit;
    }
  }
  virtual bool ordered(const Sphere* window) const = 0;
};

class OrderOfCentres final : public FaultyOrder {
  bool ordered(const Sphere* s) const override {
    const std::uint32_t last = 2 * BlockTree::block - 1;
    const double x = double{s[last].x} - s[0].x, y = double{s[last].y} - s[0].y,
                 z = double{s[last].z} - s[0].z;
    const auto along = [&](std::uint32_t k) { return x * s[k].x + y * s[k].y + z * s[k].z; };
    for (std::uint32_t k = 0; k < last; ++k)
      if (!(along(k) < along(k + 1))) return false;
    return true;
  }
};
const RegisterMutant<OrderOfCentres> centres{"order-of-centres",
                                             "an order that forgets the radii: no slack for what touches"};

/// As core/blocks/ordered-inl.h has it, along the way from first to last, in binary32: but what is rounded is
/// taken for what is.
class OrderWithoutSlack final : public FaultyOrder {
  bool ordered(const Sphere* s) const override {
    constexpr std::uint32_t last = 2 * BlockTree::block - 1;
    const float x = s[last].x - s[0].x, y = s[last].y - s[0].y, z = s[last].z - s[0].z,
                length = std::sqrt(x * x + y * y + z * z);
    const auto along = [&](std::uint32_t k) {
      return x * (s[k].x - s[0].x) + y * (s[k].y - s[0].y) + z * (s[k].z - s[0].z);
    };
    const auto low = [&](std::uint32_t k) { return along(k) - s[k].radius * length; };
    for (std::uint32_t k = 0; k < last; ++k) {
      if (!(low(k) <= low(k + 1))) return false;
      if (k + 2 <= last && !(along(k) + s[k].radius * length < low(k + 2))) return false;
    }
    return true;
  }
};
const RegisterMutant<OrderWithoutSlack> no_slack{
    "order-without-slack", "a certificate of order that takes rounded ends of spheres for exact ones"};

class OrderOfTheFirst final : public FaultyOrder {
  bool ordered(const Sphere* s) const override {
    for (std::uint32_t k = 0; k + 2 < BlockTree::block; ++k) {
      const double x = double{s[k + 2].x} - s[k].x, y = double{s[k + 2].y} - s[k].y,
                   z = double{s[k + 2].z} - s[k].z;
      const double reach = double{s[k + 2].radius} + s[k].radius;
      if (x * x + y * y + z * z <= reach * reach * 1.000001) return false;
    }
    return true;
  }
};
const RegisterMutant<OrderOfTheFirst> first{"order-of-the-next-but-one",
                                            "a chain that comes back within a window"};

class BoxOfAxes final : public FaultyBlocks {
  void tamper(const ChainView&, BlockTree& tree) override {
    for (BlockTree::Level& level : tree.level)
      for (std::uint32_t k = 0; k < level.count; ++k)
        for (std::uint32_t d = 12; d < 15; ++d)
          level.at(k)[d * BlockTree::group + k % BlockTree::group] *= 0.75f;
  }
};
const RegisterMutant<BoxOfAxes> box{"node-box-too-small", "half sides that leave the thickness out"};

/// A row of each node whose bits `row` says so of.
class FaultyRows : public FaultyBlocks {
  void tamper(const ChainView& chain, BlockTree& tree) override {
    for (std::size_t l = 0; l < tree.level.size(); ++l)
      for (std::uint32_t k = 0; k < tree.level[l].count; ++k) {
        const auto bit = static_cast<std::uint16_t>(1u << k % BlockTree::group);
        BlockTree::Level& level = tree.level[l];
        if (row(chain, tree, l, k)) level.in_a_row[k / BlockTree::group] |= bit;
        if (k + 1 < level.count && seam(tree, l, k)) level.with_the_next[k / BlockTree::group] |= bit;
      }
  }
  virtual bool row(const ChainView&, const BlockTree&, std::size_t, std::uint32_t) const { return false; }
  virtual bool seam(const BlockTree&, std::size_t, std::uint32_t) const { return false; }
};

/// Neighbouring blocks lie apart as a row's do, and the row comes back.
class RowOfNeighbours final : public FaultyRows {
  bool row(const ChainView& chain, const BlockTree& tree, std::size_t l, std::uint32_t k) const override {
    if (l > 0) return false;
    const std::uint32_t begin = k * BlockTree::group, count = tree.blocks_of(k);
    for (std::uint32_t b = begin; b + 2 < begin + count; ++b) {
      const Sphere &one = tree.spheres(chain, b)[0], &other = tree.spheres(chain, b + 2)[0];
      const double x = double{other.x} - one.x, y = double{other.y} - one.y, z = double{other.z} - one.z;
      if (x * x + y * y + z * z <= 4.0 * one.radius * one.radius) return false;
    }
    return true;
  }
};
const RegisterMutant<RowOfNeighbours> back{"row-that-comes-back", "a row judged by the next but one alone"};

/// A node that is in a row is taken to be so with whatever follows.
class RowWithoutSeam final : public FaultyRows {
  bool seam(const BlockTree& tree, std::size_t l, std::uint32_t k) const override {
    return tree.in_a_row(l, k);
  }
};
const RegisterMutant<RowWithoutSeam> unseen{"row-that-ends-unseen", "the next node is not looked at"};

/// Of two nodes in a row the last block and the next one's first are never compared.
class SeamLost final : public FaultyBlocks {
  void tamper(const ChainView&, BlockTree& tree) override {
    for (std::uint32_t g = 0; g < tree.level[0].count; ++g)
      if (tree.with_the_next(0, g)) tree.ordered[g] |= 0x8000;
  }
};
const RegisterMutant<SeamLost> seam{"seam-of-a-row-lost", "what only adjacent spheres may touch, unproved"};

/// What the greatest spheres would have for neighbours is not compared.
class NeighboursByTheGreatest final : public FaultyBlocks {
  void search(const ChainView& chain, PairCollector& collector) override {
    ChainView thick = chain;
    thick.extent.least_radius = chain.extent.greatest_radius;
    FaultyBlocks::search(thick, collector);
  }
};
const RegisterMutant<NeighboursByTheGreatest> thick{"neighbours-by-the-greatest-radius",
                                                    "an arc window as wide as for the thickest spheres"};

/// Crowded nodes are left to a grid that is not there for pairs of them.
class CrowdWithoutGrid final : public FaultyBlocks {
  void search(const ChainView& chain, PairCollector& collector) override {
    find_crowds(chain, tree(), 1, crowding_, team());
    search_uncrowded(chain, tree(), crowding_, queues(), collector, team());
  }
  Crowding crowding_;
};
const RegisterMutant<CrowdWithoutGrid> crowd{"crowd-left-alone",
                                             "each of two searches leaves a pair to the other"};

}  // namespace
}  // namespace catena::properties
