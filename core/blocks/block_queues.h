#pragma once
#include <cstdint>
#include <span>

#include "catena/core/executor/large_vector.h"
#include "catena/core/pair.h"

namespace catena {

/// What a block search has found and not looked into yet. Queues instead of nested loops: each test runs over
/// many things at a time, without a branch that is hard to foretell between them, and what the next ones need
/// is fetched ahead.
class BlockQueues {
 public:
  /// A block against those of a group of sixteen.
  struct Row {
    std::uint32_t block, group, lanes;
  };

  BlockQueues() : rows_(row_room), pairs_(pair_room), hits_(hit_room) {}

  void clear() { row_count_ = pair_count_ = 0; }

  /// Ignored when no lane is left. At most one node against another between two calls of rows_full.
  void add_row(const Row& row) {
    rows_[row_count_] = row;
    row_count_ += row.lanes != 0;
  }
  bool rows_full() const { return row_count_ > row_limit; }
  std::span<const Row> rows() const { return {rows_.data(), row_count_}; }
  void clear_rows() {
    rows_done_ += row_count_;
    row_count_ = 0;
  }

  /// Blocks i and j. At most one row, or a node's along the chain, between two calls of pairs_full.
  void add_pair(const Pair& pair) { pairs_[pair_count_++] = pair; }
  /// Or so many that were stored here, where a vector may write past the last.
  Pair* next_pairs() { return pairs_.data() + pair_count_; }
  void add_pairs(std::size_t count) { pair_count_ += count; }
  bool pairs_full() const { return pair_count_ > pair_limit; }
  std::span<const Pair> pairs() const { return {pairs_.data(), pair_count_}; }
  void clear_pairs() {
    pairs_done_ += pair_count_;
    pair_count_ = 0;
  }

  /// Room for colliding spheres, with what a vector writes past the last: past hit_limit they are to be
  /// handed over before the next eight pairs of blocks, or the next two spheres of each block of a run.
  static constexpr std::size_t hit_limit = 448;
  Pair* hits() { return hits_.data(); }

  /// Pairs of blocks that were looked into without having waited.
  void add_looked(std::size_t pairs) { pairs_done_ += pairs; }

  /// Pairs of spheres that binary32 left open.
  void add_open(std::size_t pairs) { open_done_ += pairs; }

  /// Rows and pairs looked into since this was made.
  std::uint64_t rows_done() const { return rows_done_; }
  std::uint64_t pairs_done() const { return pairs_done_; }
  std::uint64_t open_done() const { return open_done_; }

 private:
  static constexpr std::size_t row_limit = 512, row_room = row_limit + 32, pair_limit = 1024,
                               pair_room = pair_limit + 64, hit_room = hit_limit + 8 * 64 + 8;

  LargeVector<Row> rows_;
  LargeVector<Pair> pairs_, hits_;
  std::size_t row_count_ = 0, pair_count_ = 0;
  std::uint64_t rows_done_ = 0, pairs_done_ = 0, open_done_ = 0;
};

}  // namespace catena
