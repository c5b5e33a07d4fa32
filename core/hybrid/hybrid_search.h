#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/space_tree/crowd_look.h"
#include "catena/core/space_tree/search_cost.h"
#include "catena/core/space_tree/space_kernels.h"
#include "catena/core/space_tree/steady_frames.h"
#include "catena/core/sphere_tree/sphere_kernels.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// A search that takes, part by part of the chain, the cheapest of three:
/// - the chain's own order: a BlockTree, where nodes of 128 spheres meet few others;
/// - the order of space: a SpaceTree of the blocks of nodes that meet more, the *crowded* ones;
/// - single spheres: of those blocks among them that have so much near them that most of their eight spheres
///   must be looked at anyway, the *dense* ones; in cells, a SphereGrid, where their radii are about the same
///   and else in the order of space, a SphereTree. So are all spheres of strands too short for blocks, and of
///   chains whose blocks meet many everywhere, as a look tells before there are any.
/// Pairs of two dense blocks are the third one's, those of two other crowded nodes the second one's, the rest
/// the first one's, so that each is met once. What is crowded or dense is told by a look at some nodes and
/// blocks, and where it is about even both ways cost about the same.
class CATENA_API HybridSearch {
 public:
  struct Settings {
    std::uint32_t crowd;       ///< a node that meets more others is crowded; see find_crowds
    double dense;              ///< a block is dense that costs more than so many times its spheres in cells
    bool rows = true;          ///< nodes whose blocks follow one another are not searched within
    float doubt = 1;           ///< see BlockTree
    bool each_radius = false;  ///< see SphereGrid
  };
  /// What the last search met, by its stages; about what the time goes into.
  struct Work {
    std::uint64_t rows = 0;                ///< a block against sixteen, in the chain's order
    std::uint64_t entries = 0;             ///< two blocks in the order of space
    std::uint64_t near = 0;                ///< eight spheres against eight
    std::uint64_t sixteens = 0;            ///< sixteen spheres, in a box, and as many in another
    std::uint64_t tests = 0;               ///< a sphere against a vector of others
    std::uint64_t open = 0;                ///< pairs of spheres that binary32 left open
    std::uint64_t crowded = 0, dense = 0;  ///< spheres of the last build's, at most
  };

  HybridSearch(const Settings& settings, unsigned threads);

  /// O(n log n), of which only n / 8 is sorted; does not allocate when n and the crowd have not grown, in a
  /// team of one. What it throws leaves nothing built. Of spheres of the last build, moved, `sort` may leave
  /// out what still holds of them: orders in space, and looks that tell which of the three is cheapest.
  void build(const ChainView& chain, const Team& team, SpaceSort sort = SpaceSort::anew);
  /// Reports every colliding pair, once. As many lanes as the team has members.
  void search(const ChainView& chain, PairCollector& collector, const Team& team);
  /// The same to one lane, by the caller alone, slower; every pair is accounted for to the sink, once.
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink);
  /// The nodes that it names: trees of the chain's order, of the order of space and of single spheres.
  void show_evidence(const ChainView& chain, BoundsVisitor& visitor) const;

  Work work() const;
  const Settings& settings() const { return settings_; }
  std::uint32_t nodes() const { return parts_.crowding.nodes(); }
  std::uint32_t crowded_nodes() const { return parts_.crowding.crowded_nodes(); }

  /// What is not searched within rows; see catena::told_rows.
  Decision told_rows() const;
  /// Some of it is sorted in space.
  bool sorts() const { return parts_.space.entries > 0 || (parts_.dense_count > 0 && !parts_.in_cells); }
  /// How much is, and when it was; see told_order.
  Decision told_order() const;
  /// The search in cells reads one radius for all.
  bool equal_radii() const { return parts_.dense_count > 0 && parts_.in_cells && parts_.grid.equal_radii; }

  /// What a build leaves for the searches; mutants spoil it.
  struct Parts {
    BlockTree tree;
    Crowding crowding;
    SpaceTree space;
    SphereGrid grid;                ///< of dense blocks' spheres
    SphereTree spheres;             ///< of them, instead
    std::uint32_t dense_count = 0;  ///< spheres of dense blocks
    bool in_cells = false;          ///< they are in the grid
  };
  Parts& parts() { return parts_; }

 private:
  struct Evidence;
  Work met() const;  ///< since this was made
  bool single_at_once(const ChainView& chain, SpaceSort sort, SingleSpheres& single);
  bool look_at(const ChainView& chain, SpaceSort sort, SingleSpheres& single);
  void build_in_space(const ChainView& chain, SingleSpheres single, const Team& team, SpaceSort sort);
  void gather_dense(const Team& team);
  bool cells_fit(const ChainView& chain, float greatest_radius, const Team& team) const;
  bool one_level() const;

  const Settings settings_;
  CrowdLook look_;
  /// What the last look told, and of which frames that holds.
  struct {
    SteadyFrames frames;
    SpaceSort sort = SpaceSort::anew;  ///< of its build
    bool at_once = false;
    SingleSpheres single{};
  } looked_;
  Work before_;  ///< met before the last search
  Parts parts_;
  /// Of no spheres while there is a tree; else the memory of the last, as the next frame may need one.
  struct {
    BlockTree tree;
    Crowding crowding;
  } put_by_;
  std::vector<std::uint32_t> dense_before_;  ///< [node]: dense spheres of earlier ones
  LargeVector<std::uint32_t> dense_;         ///< all, ascending; empty where all of the chain are
  // [member of the team]
  std::vector<BlockQueues> block_queues_;
  std::vector<SpaceQueue> entry_queues_;
  std::vector<GridQueues> grid_queues_;
  std::vector<SphereQueues> sphere_queues_;
};

}  // namespace catena
