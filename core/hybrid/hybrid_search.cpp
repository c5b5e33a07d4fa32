#include "catena/core/hybrid/hybrid_search.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <utility>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/blocks/told_rows.h"
#include "catena/core/grid/grid_evidence.h"
#include "catena/core/hybrid/crowd_evidence.h"
#include "catena/core/space_tree/search_cost.h"
#include "catena/core/space_tree/space_evidence.h"
#include "catena/core/space_tree/tangled.h"
#include "catena/core/space_tree/told_order.h"

namespace catena {
namespace {

/// Queues for that many members of a team, made when they are needed first: most chains need none.
template <class Queues>
std::vector<Queues>& of_members(std::vector<Queues>& queues, unsigned members) {
  if (queues.size() < members) queues.resize(members);
  return queues;
}

}  // namespace

HybridSearch::HybridSearch(const Settings& settings, unsigned threads)
    : settings_(settings), block_queues_(threads) {}

void HybridSearch::build(const ChainView& chain, const Team& team, SpaceSort sort) {
  parts_.grid.each_radius = settings_.each_radius;
  parts_.space.entries = 0;
  dense_.clear();
  parts_.dense_count = 0;
  SingleSpheres single{};
  const bool at_once = single_at_once(chain, sort, single);
  if (parts_.tree.level.empty() != at_once) {
    std::swap(parts_.tree, put_by_.tree);
    std::swap(parts_.crowding, put_by_.crowding);
  }
  // Of that tree which is searched now.
  parts_.tree.doubt = parts_.grid.doubt = parts_.spheres.doubt = settings_.doubt;
  if (at_once) {
    parts_.crowding.reset(parts_.tree, settings_.crowd, team.size());
    parts_.dense_count = chain.size;
  } else {
    build_block_tree(chain, parts_.tree, team);
    if (!settings_.rows) parts_.tree.forget_rows();
    find_crowds(chain, parts_.tree, settings_.crowd, parts_.crowding, team);
    if (parts_.crowding.crowded_nodes() > 0) {
      single = single_spheres(chain, parts_.tree, parts_.crowding, sort);
      build_in_space(chain, single, team, sort);
      // Then the next frames need not be looked at so closely.
      if (parts_.dense_count == chain.size) looked_.at_once = true, looked_.single = single;
    }
  }
  if (parts_.dense_count == 0) return;
  parts_.in_cells = single.in_cells && cells_fit(chain, single.greatest_radius, team);
  if (parts_.in_cells) {
    parts_.grid.wide = single.wide;
    build_grid(chain, parts_.grid, dense_, team);
    parts_.in_cells = one_level();
  }
  if (!parts_.in_cells) build_sphere_tree(chain, parts_.spheres, dense_, team, sort);
}

/// Whether no order of blocks is worth its while; then single spheres' cost is told too. What was seen of the
/// frame before holds while little moves; what was seen of a first one not, which had all to sort.
bool HybridSearch::single_at_once(const ChainView& chain, SpaceSort sort, SingleSpheres& single) {
  if (sort == SpaceSort::anew || looked_.sort != sort || !looked_.frames.still(chain)) {
    looked_.frames.looked(chain);
    looked_.sort = sort;
    looked_.at_once = look_at(chain, sort, looked_.single);
  }
  single = looked_.single;
  return looked_.at_once;
}

/// A block that has more blocks near it, in the chain's order and in that of space, costs more than its
/// spheres one by one.
bool HybridSearch::look_at(const ChainView& chain, SpaceSort sort, SingleSpheres& single) {
  if (blocks_half_empty(chain)) {
    if (chain.size > 0) single = single_spheres(chain, sort);
    return true;
  }
  // Between short strands a chain jumps so often that its nodes tell nothing of what is near. Of few nodes
  // all are soon looked at.
  constexpr std::uint32_t few = 4096;
  const std::uint32_t short_strand = chain.size > few ? 32 : 14;
  if (chain.size <= std::uint64_t{short_strand} * chain.strand_count && tangled(chain)) {
    single = single_spheres(chain, sort);
    if (single.in_cells && single.wide) return true;
  }
  constexpr double least = 6;  // in wide cells with nothing near
  const double share = settings_.dense * shallow_share(chain.size),
               octaves = octaves_beyond_cache(chain.size);
  if (!look_.everywhere(chain, share * least, 2)) return false;
  single = single_spheres(chain, sort);
  // Of a single sphere, from memory; more is for pairs, which take as long in any order where they are few,
  // and among blocks less where they are many.
  const double usual_ns = 70 + 6 * octaves, pair = 0.8;
  const double many = (16 + 1.1 * octaves) * std::max(1.0, single.ns / usual_ns) + pair * single.pairs,
               others = std::min(many, single.ns * BlockTree::block / SpaceCost::near_ns);
  // After the first look a tree is most likely made in vain: it takes more to be held for needed.
  return others <= least || look_.everywhere(chain, share * others, 3);
}

void HybridSearch::build_in_space(const ChainView& chain, SingleSpheres single, const Team& team,
                                  SpaceSort sort) {
  single.ns *= settings_.dense;
  build_space_tree(chain, parts_.tree, parts_.crowding, parts_.space, single,
                   of_members(entry_queues_, team.size()), team, sort);
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
    search_space_tree(chain, parts_.tree, parts_.space, of_members(entry_queues_, team.size()), block_queues_,
                      collector, team);
  if (parts_.dense_count == 0) return;
  if (parts_.in_cells)
    search_grid(chain, parts_.grid, of_members(grid_queues_, team.size()), collector, team);
  else
    search_sphere_tree(chain, parts_.spheres, of_members(sphere_queues_, team.size()), collector, team);
}

/// The nodes of each of the searches that there is.
struct HybridSearch::Evidence {
  CrowdNodes chain;
  std::optional<SpaceNodes> space;
  std::optional<GridTrees> cells;
  std::optional<SphereNodes> spheres;

  Evidence(const ChainView& view, const HybridSearch& of) : chain(view, of.parts_.tree, of.parts_.crowding) {
    std::uint32_t next = chain.end_id();
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
  std::optional<SpaceEvidence> space;
  if (nodes.space) {
    space.emplace(chain, *nodes.space, sink);
    search_space_tree(chain, parts_.tree, parts_.space, of_members(entry_queues_, 1)[0], block_queues_[0],
                      lane, *space);
  }
  CrowdSink uncrowded(nodes.chain, space ? &*space : nullptr, sink);
  search_uncrowded(chain, parts_.tree, parts_.crowding, block_queues_[0], lane,
                   BlockEvidence(chain, parts_.tree, uncrowded));
  if (nodes.spheres)
    search_sphere_tree(chain, parts_.spheres, of_members(sphere_queues_, 1)[0], lane,
                       SphereEvidence(chain, *nodes.spheres, sink));
  if (!nodes.cells) return;
  GridEvidence cells(chain, *nodes.cells, sink);
  search_grid(chain, parts_.grid, of_members(grid_queues_, 1)[0], lane, cells);
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

Decision HybridSearch::told_rows() const { return catena::told_rows(parts_.tree, &parts_.crowding); }

Decision HybridSearch::told_order() const {
  std::uint32_t sorted = 0, frames = 0;
  const auto take = [&](std::uint32_t entries, const KeptOrder& kept) {
    sorted += entries, frames = std::max(frames, kept.frames());
  };
  if (parts_.space.entries > 0) take(parts_.space.entries, parts_.space.kept);
  if (parts_.dense_count > 0 && !parts_.in_cells) take(parts_.spheres.spheres, parts_.spheres.kept);
  return catena::told_order(sorted, frames);
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
  work.crowded = std::max(
      work.dense, std::uint64_t{parts_.crowding.crowded_nodes()} * BlockTree::group * BlockTree::block);
  return work;
}

}  // namespace catena
