#include "catena/core/hybrid/hybrid_search.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <utility>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/grid/grid_evidence.h"
#include "catena/core/hybrid/crowd_evidence.h"
#include "catena/core/lone_spheres/lone_evidence.h"
#include "catena/core/space_tree/search_cost.h"
#include "catena/core/space_tree/space_evidence.h"

namespace catena {

HybridSearch::HybridSearch(const Settings& settings, unsigned threads)
    : settings_(settings),
      block_queues_(threads),
      entry_queues_(threads),
      grid_queues_(threads),
      sphere_queues_(threads) {}

void HybridSearch::build(const ChainView& chain, const Team& team) {
  parts_.grid.each_radius = settings_.each_radius;
  parts_.space.entries = 0;
  dense_.clear();
  parts_.dense_count = 0;
  const bool sparse = leave_out_lone_spheres(chain, team);
  SingleSpheres single{};
  // A block that meets more is dense, in the chain's order and in that of space.
  const double others =
      settings_.dense * shallow_share(chain.size) * (9 + 0.75 * octaves_beyond_cache(chain.size));
  const bool at_once = sparse || unfilled(chain) || look_.everywhere(chain, others);
  if (parts_.tree.level.empty() != at_once) {
    std::swap(parts_.tree, put_by_.tree);
    std::swap(parts_.crowding, put_by_.crowding);
  }
  // Of that tree which is searched now.
  parts_.tree.doubt = parts_.grid.doubt = parts_.spheres.doubt = settings_.doubt;
  if (at_once) {
    parts_.crowding.reset(parts_.tree, settings_.crowd, team.size());
    parts_.dense_count = chain.size - parts_.lone_count;
    if (!sparse && chain.size > 0) single = single_spheres(chain);
  } else {
    build_block_tree(chain, parts_.tree, team);
    if (!settings_.rows) parts_.tree.forget_rows();
    find_crowds(chain, parts_.tree, settings_.crowd, parts_.crowding, team);
    if (parts_.crowding.crowded_nodes() > 0) {
      single = single_spheres(chain, parts_.tree, parts_.crowding);
      build_in_space(chain, single, team);
    }
  }
  if (parts_.dense_count == 0) return;
  parts_.in_cells = single.in_cells && cells_fit(chain, single.greatest_radius, team);
  if (parts_.in_cells) {
    build_grid(chain, parts_.grid, dense_, team);
    parts_.in_cells = one_level();
  }
  if (!parts_.in_cells) build_sphere_tree(chain, parts_.spheres, dense_, team);
}

/// Where most are alone: all others are dense then.
bool HybridSearch::leave_out_lone_spheres(const ChainView& chain, const Team& team) {
  parts_.lone_count = 0;
  const std::optional<LoneCells> cells = LoneCells::of(chain.extent, chain.size);
  if (!cells || !lone_.pay(chain, *cells)) return false;
  lone_.leave_out(chain, *cells, dense_, team);
  parts_.lone_count = chain.size - static_cast<std::uint32_t>(dense_.size());
  return true;
}

/// Strands are so short that their blocks would be half empty, or more.
bool HybridSearch::unfilled(const ChainView& chain) {
  return chain.strand_count > 1 && std::uint64_t{count_blocks(chain)} * (BlockTree::block / 2) >= chain.size;
}

void HybridSearch::build_in_space(const ChainView& chain, SingleSpheres single, const Team& team) {
  single.ns *= settings_.dense;
  build_space_tree(chain, parts_.tree, parts_.crowding, parts_.space, single, entry_queues_, team);
  if (parts_.space.entries == 0 && parts_.crowding.crowded_nodes() == parts_.crowding.nodes()) {
    parts_.dense_count = chain.size;  // their list need not be made
  } else {
    gather_dense(team);
    parts_.dense_count = static_cast<std::uint32_t>(dense_.size());
  }
}

void HybridSearch::search(const ChainView& chain, PairCollector& collector, const Team& team) {
  before_ = met();
  search_uncrowded(chain, parts_.tree, parts_.crowding, block_queues_, collector, team);
  if (parts_.space.entries > 0)
    search_space_tree(chain, parts_.tree, parts_.space, entry_queues_, block_queues_, collector, team);
  if (parts_.dense_count == 0) return;
  if (parts_.in_cells)
    search_grid(chain, parts_.grid, grid_queues_, collector, team);
  else
    search_sphere_tree(chain, parts_.spheres, sphere_queues_, collector, team);
}

/// The nodes of each of the searches that there is.
struct HybridSearch::Evidence {
  CrowdNodes chain;
  std::optional<SpaceNodes> space;
  std::optional<GridTrees> cells;
  std::optional<SphereNodes> spheres;
  SphereTree all;  ///< with those that are alone, if there are any, for these to be apart from nodes of it

  Evidence(const ChainView& view, const HybridSearch& of) : chain(view, of.parts_.tree, of.parts_.crowding) {
    std::uint32_t next = chain.end_id();
    if (of.parts_.lone_count > 0) {
      build_sphere_tree(view, all, {}, Team());
      spheres.emplace(all, next);
      return;
    }
    if (of.parts_.space.entries > 0)
      next = space.emplace(view, of.parts_.tree, of.parts_.space, next).end_id();
    if (of.parts_.dense_count == 0) return;
    if (of.parts_.in_cells)
      cells.emplace(view, of.parts_.grid, next);
    else
      spheres.emplace(of.parts_.spheres, next);
  }
};

void HybridSearch::search_with_evidence(const ChainView& chain, PairCollector::Lane& lane,
                                        EvidenceSink& sink) {
  before_ = met();
  const Evidence nodes(chain, *this);
  if (parts_.lone_count > 0) return search_beside_lone_spheres(chain, nodes, lane, sink);
  std::optional<SpaceEvidence> space;
  if (nodes.space) {
    space.emplace(chain, *nodes.space, sink);
    search_space_tree(chain, parts_.tree, parts_.space, entry_queues_[0], block_queues_[0], lane, *space);
  }
  CrowdSink uncrowded(nodes.chain, space ? &*space : nullptr, sink);
  search_uncrowded(chain, parts_.tree, parts_.crowding, block_queues_[0], lane,
                   BlockEvidence(chain, parts_.tree, uncrowded));
  if (nodes.spheres)
    search_sphere_tree(chain, parts_.spheres, sphere_queues_[0], lane,
                       SphereEvidence(chain, *nodes.spheres, sink));
  if (!nodes.cells) return;
  GridEvidence cells(chain, *nodes.cells, sink);
  search_grid(chain, parts_.grid, grid_queues_[0], lane, cells);
}

/// The pairs of spheres that are not alone, and then where all pairs are.
void HybridSearch::search_beside_lone_spheres(const ChainView& chain, const Evidence& nodes,
                                              PairCollector::Lane& lane, EvidenceSink& sink) {
  std::span<const std::uint32_t> others;
  if (parts_.dense_count > 0) {
    others = {parts_.spheres.index.data(), parts_.spheres.spheres};
    const SphereNodes unnamed(parts_.spheres, chain.size);
    NoOnesSink nothing;
    search_sphere_tree(chain, parts_.spheres, sphere_queues_[0], lane,
                       SphereEvidence(chain, unnamed, nothing));
  }
  LoneSink apart(chain.size, others, sink);
  Collisions found;
  PairCollector unheard(chain.size, {}, found, 1);
  SphereQueues queues;
  search_sphere_tree(chain, nodes.all, queues, unheard.lane(0), SphereEvidence(chain, *nodes.spheres, apart));
}

void HybridSearch::show_evidence(const ChainView& chain, BoundsVisitor& visitor) const {
  const Evidence nodes(chain, *this);
  nodes.chain.show(visitor);
  if (nodes.space) nodes.space->show(visitor);
  if (nodes.cells) nodes.cells->show(visitor);
  if (nodes.spheres) nodes.spheres->show(visitor);
}

void HybridSearch::gather_dense(const Team& team) {
  // Counted first, so that each thread knows where its own come.
  const auto for_each = [&](std::uint32_t node, const auto& body) {
    const std::uint32_t begin = node * BlockTree::group, dense = parts_.crowding.dense(node);
    for (std::uint32_t b = begin; dense != 0 && b < begin + parts_.tree.blocks_of(node); ++b) {
      if ((dense >> (b - begin) & 1) == 0) continue;
      for (std::uint32_t k = 0; k < BlockTree::block; ++k)
        if (const std::uint32_t i = parts_.tree.index(b, k); i != BlockTree::no_sphere) body(i);
    }
  };
  constexpr std::uint32_t nodes_of_a_task = 64;
  const auto for_each_node = [&](const auto& body) {
    team.for_each_range(parts_.crowding.nodes(), nodes_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          for (std::uint32_t node = begin; node < end; ++node) body(node);
                        });
  };
  dense_before_.assign(parts_.crowding.nodes() + 1, 0);
  for_each_node(
      [&](std::uint32_t node) { for_each(node, [&](std::uint32_t) { ++dense_before_[node + 1]; }); });
  std::partial_sum(dense_before_.begin(), dense_before_.end(), dense_before_.begin());
  dense_.resize(dense_before_.back());
  for_each_node([&](std::uint32_t node) {
    std::uint32_t* to = dense_.data() + dense_before_[node];
    for_each(node, [&](std::uint32_t i) { *to++ = i; });
  });
}

/// Cells have one width, or one an octave: a few spheres that are much greater than all others would have all
/// others look for them.
bool HybridSearch::cells_fit(const ChainView& chain, float greatest_radius, const Team& team) const {
  constexpr std::uint32_t spheres_of_a_task = 1 << 14;
  const float most = 2 * greatest_radius;
  if (chain.extent.greatest_radius <= most) return true;
  std::atomic<bool> fit = true;
  team.for_each_range(parts_.dense_count, spheres_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t k = begin; k < end; ++k)
      if (chain.spheres[dense_.empty() ? k : dense_[k]].radius > most) fit = false;
  });
  return fit;
}

/// Of a few at most the cells turned out to be too wide.
bool HybridSearch::one_level() const {
  constexpr std::uint32_t few = 64;  // one in so many
  const std::uint32_t others = parts_.dense_count - parts_.grid.levels.front().end;
  return others <= parts_.dense_count / few;
}

HybridSearch::Work HybridSearch::met() const {
  Work work;
  for (const BlockQueues& queues : block_queues_) {
    work.rows += queues.rows_done();
    work.near += queues.pairs_done();
    work.open += queues.open_done();
  }
  for (const SpaceQueue& queue : entry_queues_) work.entries += queue.done;
  for (const GridQueues& queues : grid_queues_)
    work.tests += queues.tests_done, work.open += queues.open_done;
  for (const SphereQueues& queues : sphere_queues_) {
    work.tests += queues.tests_done, work.open += queues.open_done;
    work.sixteens += queues.nodes_done;
  }
  return work;
}

HybridSearch::Work HybridSearch::work() const {
  Work work = met();
  work.rows -= before_.rows, work.near -= before_.near;
  work.entries -= before_.entries, work.tests -= before_.tests, work.open -= before_.open;
  work.sixteens -= before_.sixteens;
  work.dense = parts_.dense_count;
  work.alone = parts_.lone_count;
  work.crowded = std::max(
      work.dense, std::uint64_t{parts_.crowding.crowded_nodes()} * BlockTree::group * BlockTree::block);
  return work;
}

}  // namespace catena
