// A look at some nodes of a BlockTree before all are walked.
#if defined(CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#undef CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#else
#define CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#endif

#include <algorithm>
#include <array>
#include <atomic>

#include "catena/core/blocks/beyond_cache.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/blocks/near_blocks-inl.h"
#include "catena/core/blocks/squares_in_range.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/team.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Of a chain, looks at some nodes, each of which stands for sixteen that follow one another: where it is
/// crowded, or one of its blocks meets so many others that its spheres are better met one by one, all are
/// taken to be.
class CrowdSample {
 public:
  CrowdSample(const ChainView& chain, const BlockTree& tree, std::uint32_t limit, Crowding& crowding,
              const Team& team)
      : chain_(chain), tree_(tree), limit_(limit), crowding_(crowding), team_(team) {}

  /// Looks at every sixteenth node. Two orders must save a good part of what one would take, as blocks of one
  /// meet those of the other in the worse of the two. Where some are crowded, looks again at the rest, which
  /// may be better off with these than in an order that they alone are left in. A few that are left then are
  /// not worth it. What a walk found crowded, which it has left out, stays so; `walked`: it has come to its
  /// end.
  void all(bool walked) {
    walked_ = walked;
    const bool left_out = crowding_.some();
    Costs costs;
    look_at_all(costs);
    if (!left_out && !costs.crowded) return;
    if (5 * costs.of_both() > 4 * std::min(costs.tree.load(), costs.cells.load())) {
      // What the walk has left out is met in another order anyway; to have two costs looks, too.
      if (costs.cells < costs.tree || (left_out && 2 * costs.cells < 3 * costs.of_both())) return crowd_all();
      if (!costs.beyond_limit && !left_out) return;
    }
    for_each_group([&](std::uint32_t g) {
      if (crowding_.seen_crowded(g)) crowd_group(g);
    });
    look_at_rest();
    constexpr std::uint32_t few = 16;  // one in so many
    if (std::uint64_t{few} * (nodes() - crowding_.crowded_nodes()) <= nodes()) crowd_all();
  }

  /// True when the chain's own order most likely serves all of it, so that looking at every sixteenth node
  /// would cost more than it can save: of a few nodes, two at least where there are, none is crowded. What is
  /// crowded all the same is met by the walk; and where that meets few pairs of nodes, what is near within
  /// them costs no more than in cells.
  bool sparse() {
    constexpr std::uint32_t most_apart = 16;  // groups
    const std::uint32_t apart = std::clamp(groups() / 2, 1u, most_apart);
    double tree_ns = 0, cells_ns = 0;
    for (std::uint32_t g = apart / 2; g < groups(); g += apart) {
      const GroupLook look = look_at(g, nullptr);
      if (seen_ < first_.size()) first_[seen_++] = {g, look};
      if (look.all.crowded()) return false;
      tree_ns += look.all.tree_ns, cells_ns += look.all.cells_ns;
    }
    cheap_ = 5 * tree_ns < 4 * cells_ns;
    return true;
  }
  /// After sparse(): the chain's order costs a fifth less than cells where that looked, so that a node may
  /// meet more others than the limit and yet cost less than in another order: long thin ones that lie across
  /// one another look into few of those they meet. Where there are few nodes not much is at stake.
  bool cheap() const { return cheap_ && few_nodes(); }
  bool few_nodes() const {
    constexpr std::uint32_t few = 256;
    return nodes() <= few;
  }
  /// The walk has met so few that this stands.
  bool stayed_sparse() const { return crowding_.pair_count() <= std::size_t{4} * nodes(); }

 private:
  static constexpr std::uint32_t group = BlockTree::group;

  /// What a sphere costs, about, in the chain's order and in cells.
  struct Look {
    double tree_ns, cells_ns;
    bool beyond_limit;  ///< and perhaps much more than that in the chain's order
    bool crowded() const { return tree_ns > cells_ns; }
    double spared() const { return crowded() ? tree_ns - cells_ns : 0; }
    bool even() const { return 2 * tree_ns < 3 * cells_ns && 2 * cells_ns < 3 * tree_ns; }
    /// What is taken for the cheaper one may be the dearer by far: only cells never are.
    bool doubtful() const { return 2 * tree_ns < 3 * cells_ns && cells_ns < 3 * tree_ns; }
  };

  std::uint32_t nodes() const { return crowding_.nodes(); }
  std::uint32_t groups() const { return (nodes() + group - 1) / group; }

  /// Looks at a group: what one of its spheres costs, about, and what another order spares of it.
  struct GroupLook {
    Look all;
    double spared_ns;
  };

  /// Of all that were looked at, in sixteenths of a nanosecond: sums that are the same in every order.
  struct Costs {
    std::atomic<std::int64_t> tree = 0, cells = 0, spared = 0;
    std::atomic<bool> crowded = false, beyond_limit = false;

    std::int64_t of_both() const { return tree - spared; }
    void take(const GroupLook& look) {
      const auto whole = [](double ns) { return static_cast<std::int64_t>(16 * ns); };
      tree += whole(look.all.tree_ns), cells += whole(look.all.cells_ns), spared += whole(look.spared_ns);
      if (look.all.crowded()) crowded = true;
      if (look.all.beyond_limit) beyond_limit = true;
    }
  };

  template <class Body>
  void for_each_group(const Body& body) const {
    constexpr std::uint32_t groups_of_a_task = 16;
    team_.for_each_range(groups(), groups_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t g = begin; g < end; ++g) body(g);
    });
  }
  void look_at_all(Costs& costs) const {
    for_each_group([&](std::uint32_t g) {
      const GroupLook look = first_look(g);
      costs.take(look);
      crowding_.seen_crowded(g) = look.all.crowded();
    });
  }
  /// That of sparse(), where it looked, unless the walk has found a crowd since.
  GroupLook first_look(std::uint32_t g) const {
    if (!walked_ || !crowding_.some())
      for (std::size_t k = 0; k < seen_; ++k)
        if (first_[k].group == g) return first_[k].look;
    return look_at(g, nullptr);
  }
  void look_at_rest() const {
    for_each_group([&](std::uint32_t g) {
      if (is_crowded(g)) return;
      if (look_at(g, &crowding_).all.crowded()) return crowd_group(g);
      // A crowd may end anywhere.
      const auto crowd_one = [&](std::uint32_t k) {
        return look(k, &crowding_).crowded() && (crowding_.crowd(k), true);
      };
      std::uint32_t begin = g * group, end = end_of(g);
      if (g > 0 && is_crowded(g - 1))
        while (begin < end && crowd_one(begin)) ++begin;
      if (g + 1 < groups() && is_crowded(g + 1))
        while (begin < end && crowd_one(end - 1)) --end;
    });
  }
  bool is_crowded(std::uint32_t g) const { return crowding_.crowded(middle(g)); }
  void crowd_group(std::uint32_t g) const {
    for (std::uint32_t k = g * group; k < end_of(g); ++k) crowding_.crowd(k);
  }
  void crowd_all() const {
    for (std::uint32_t k = 0; k < nodes(); ++k) crowding_.crowd(k);
  }

  /// The node in the middle of group g.
  std::uint32_t middle(std::uint32_t g) const { return (g * group + end_of(g)) / 2; }
  std::uint32_t end_of(std::uint32_t g) const { return std::min(nodes(), (g + 1) * group); }

  /// What most likely all of group g cost. One block tells little where both orders would cost about the
  /// same, a crowd with holes costs both, and of a few groups each is a good part of the chain: then more are
  /// asked. What is spared is told by one of them where the others say that it is crowded, as chance would
  /// spare something too.
  GroupLook look_at(std::uint32_t g, const Crowding* among) const {
    constexpr std::uint32_t most = 4, few_groups = 4;
    const std::uint32_t first = g * group, size = end_of(g) - first, fewest = groups() < few_groups ? 2 : 1;
    std::array<Look, most> each;
    Look sum{};
    std::uint32_t looks = 0;
    const auto ask = [&](std::uint32_t node) {
      const Look one = each[looks++] = look(first + node, among);
      sum.tree_ns += one.tree_ns, sum.cells_ns += one.cells_ns;
      sum.beyond_limit |= one.beyond_limit;
    };
    ask(size / 2);
    if (fewest > 1) ask(size / 4);
    if (looks == 1 && !sum.even()) return {sum, sum.spared()};
    if (looks == 1 || (fewest == 1 ? sum.doubtful() : sum.even()))
      for (std::uint32_t k = 0; k < 2; ++k) ask((1 + 4 * k) * size / 6);
    double spared_ns = 0;
    for (std::uint32_t k = 0; k < looks; ++k)
      if (sum.tree_ns - each[k].tree_ns > sum.cells_ns - each[k].cells_ns)
        spared_ns += each[k].tree_ns - each[k].cells_ns;
    return {{sum.tree_ns / looks, sum.cells_ns / looks, sum.beyond_limit}, spared_ns / looks};
  }

  Look look(std::uint32_t node, const Crowding* among) const {
    constexpr std::uint32_t plenty = 256, usual = 8;  // of blocks and candidates in a crowd
    const Look many{4 * in_cells(usual), in_cells(usual), true};
    // The walk has told which nodes meet too many, and what it took is spent.
    if (walked_ ? crowding_.crowded(node) && among == nullptr : meets_many(node, among)) return many;
    const std::uint32_t b = tree_.some_block_of(node);
    const NearBlocks near(chain_, tree_, b, plenty, among);
    if (near.enough()) return many;
    // Not all of what is near is counted where that can make no difference: pairs that overlap cost the tree
    // less than cells take for all that is near them.
    const double ns = unfilled_ * SphereCost::in_tree(near), most = ns + SphereCost::most_of_pairs(near);
    if (ns <= in_cells(0)) return {ns, in_cells(0), false};
    const SpheresAround around = spheres_around(
        chain_, tree_, b, near,
        SphereCost::candidates((among != nullptr ? 1.5 * most : most) / share_, beyond_), among);
    return {ns + SphereCost::of_pairs(near, around.overlaps), in_cells(around.candidates), false};
  }
  double in_cells(std::uint32_t candidates) const {
    return share_ * SphereCost::in_cells(candidates, beyond_) + change_;
  }
  /// More others than the limit, or as much is to be looked at on the way to them.
  bool meets_many(std::uint32_t node, const Crowding* among) const {
    constexpr std::uint64_t whole = SphereCost::looks_a_node();
    // Others, itself, and what leads to it.
    const std::uint64_t most = (std::uint64_t{limit_} + 1) * whole + tree_.level.size() - 1;
    std::uint64_t met = 0;
    const auto add = [&](std::uint64_t more) { return (met += more) <= most; };
    const auto others = [&](std::uint32_t k) { return add(pays(among, k) * whole); };
    for_each_met(tree_, node, others, [&] { return add(1); });
    return met > most;
  }

  const ChainView& chain_;
  const BlockTree& tree_;
  const std::uint32_t limit_;
  Crowding& crowding_;
  const Team& team_;
  bool walked_ = false, cheap_ = false;
  struct FirstLook {
    std::uint32_t group;
    GroupLook look;
  };
  std::array<FirstLook, 8> first_;
  std::size_t seen_ = 0;
  const double beyond_ = octaves_beyond_cache(chain_.size);
  /// Of what a search in cells takes of many spheres in range.
  const double share_ = single_spheres_share(chain_.extent) * shallow_share(chain_.size);
  const double unfilled_ = double{BlockTree::block} * tree_.blocks / chain_.size;  ///< times as many blocks
  /// What it takes to change to another order, told which: some looks, whatever the chain's length.
  static constexpr double change_ns = 10'000;
  const double change_ = change_ns / chain_.size;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
