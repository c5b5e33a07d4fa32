#pragma once
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/pair.h"

namespace catena {

/// Which nodes of a BlockTree lie among so many others that another search will do better, and which pairs of
/// nodes are left for the tree. A node is crowded once it has met more than `limit` others; a pair of crowded
/// nodes is left out. So the tree's work is bounded by limit times the number of nodes, whatever the chain.
/// Several threads may walk the tree at once: a node that is crowded stays so, and what one of them leaves
/// out is left out in the end, however they meet.
class Crowding {
 public:
  /// `threads` will walk the tree at once.
  void reset(const BlockTree& tree, std::uint32_t limit, unsigned threads) {
    limit_ = limit;
    pairs_.resize(threads);
    for (auto& pairs : pairs_) pairs.clear();
    // Of one thread, which finds all: each node meets the next, and others where a chain comes back.
    if (threads == 1 && !tree.level.empty()) pairs_[0].reserve(2 * std::size_t{tree.level[0].count});
    open_.resize(tree.level.size());
    for (std::size_t l = 0; l < open_.size(); ++l) {
      open_[l].assign(tree.level[l].count, l == 0 ? 1 : 0);
      if (l > 0)
        for (std::uint32_t k = 0; k < open_[l - 1].size(); ++k)
          open_[l][k / BlockTree::group] += open_[l - 1][k];
    }
    partners_.assign(open_.empty() ? 0 : open_[0].size(), 0);
    seen_crowded_.resize(partners_.size() / BlockTree::group + 1);
    some_ = 0;
  }

  /// Another limit, before any have met.
  void set_limit(std::uint32_t limit) { limit_ = limit; }

  std::uint32_t nodes() const { return static_cast<std::uint32_t>(partners_.size()); }
  bool crowded(std::uint32_t node) const { return read(partners_[node]) > limit_; }
  /// At least one node is crowded; of most chains none is, and nothing else need be looked up.
  bool some() const { return read(some_) != 0; }
  bool left_out(const Pair& nodes) const { return some() && crowded(nodes.i) && crowded(nodes.j); }
  std::uint32_t crowded_nodes() const { return some() ? nodes() - read(open_.back()[0]) : 0; }
  /// Nodes that met, in the order of each thread's walk; both may be crowded by now.
  std::span<const std::vector<Pair>> pairs() const { return pairs_; }
  std::span<std::vector<Pair>> pairs() { return pairs_; }
  std::size_t pair_count() const {
    std::size_t count = 0;
    for (const auto& pairs : pairs_) count += pairs.size();
    return count;
  }

  /// Bit k: block k of a crowded node is dense: its pairs with other such blocks are left to a search that
  /// does not know of blocks. All are until something else is said.
  std::uint16_t& dense(std::uint32_t node) { return dense_[node]; }
  std::uint16_t dense(std::uint32_t node) const { return dense_[node]; }
  /// Block k of a node is dense; several threads may say so.
  void make_dense(std::uint32_t node, std::uint32_t k) {
    const auto bit = static_cast<std::uint16_t>(1u << k);
    if (pairs_.size() > 1)
      std::atomic_ref(dense_[node]).fetch_or(bit, std::memory_order_relaxed);
    else
      dense_[node] |= bit;
  }
  /// To be called after the walk.
  void all_dense() {
    dense_.assign(nodes(), 0);
    for (std::uint32_t k = 0; some() && k < nodes(); ++k) dense_[k] = crowded(k) ? 0xFFFF : 0;
  }

  /// Nodes a and b of level 0 meet, as a thread found.
  void met(std::uint32_t a, std::uint32_t b, unsigned thread) {
    pairs_[thread].push_back({a, b});
    for (const std::uint32_t k : {a, b})
      if (!crowded(k) && add(partners_[k], 1) == limit_) close(k);
  }
  /// A node is crowded, as is known without the walk, before it begins or after its end. No other thread says
  /// so of the same node.
  void crowd(std::uint32_t node) {
    if (crowded(node)) return;
    std::atomic_ref(partners_[node]).store(limit_ + 1, std::memory_order_relaxed);  // others may look at it
    close(node);
  }
  /// What a look at sixteen nodes that follow one another says of them, before anything is done about it.
  std::uint8_t& seen_crowded(std::uint32_t sixteen) { return seen_crowded_[sixteen]; }
  /// Every pair of a node below a and one below b is left out.
  bool left_out(std::size_t l, std::uint32_t a, std::uint32_t b) const {
    return some() && read(open_[l][a]) == 0 && read(open_[l][b]) == 0;
  }
  /// Every pair of a node below a and one below a child of `parent` is.
  bool left_out_group(std::size_t l, std::uint32_t a, std::uint32_t parent) const {
    return some() && read(open_[l][a]) == 0 && read(open_[l + 1][parent]) == 0;
  }

 private:
  void close(std::uint32_t node) {
    std::atomic_ref(some_).store(1, std::memory_order_relaxed);
    for (auto& level : open_) add(level[node], ~std::uint32_t{0}), node /= BlockTree::group;
  }
  static std::uint32_t read(const std::uint32_t& number) {
    return std::atomic_ref(const_cast<std::uint32_t&>(number)).load(std::memory_order_relaxed);
  }
  /// Adds, and gives what was there; atomically, where there are threads.
  std::uint32_t add(std::uint32_t& to, std::uint32_t number) {
    if (pairs_.size() > 1) return std::atomic_ref(to).fetch_add(number, std::memory_order_relaxed);
    const std::uint32_t before = to;
    to += number;
    return before;
  }

  std::uint32_t limit_ = 0;
  std::uint32_t some_ = 0;               // 1: a node is crowded
  std::vector<std::uint32_t> partners_;  // of each node: others it met, counted to just above the limit
  std::vector<std::uint16_t> dense_;
  std::vector<std::uint8_t> seen_crowded_;
  std::vector<std::vector<Pair>> pairs_;          // [thread]
  std::vector<std::vector<std::uint32_t>> open_;  // [level][node]: nodes below that are not crowded
};

}  // namespace catena
