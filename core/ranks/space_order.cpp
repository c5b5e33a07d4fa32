#include "catena/core/ranks/space_order.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "catena/core/hierarchy/box_around.h"
#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/move_shares.h"
#include "catena/core/ranks/tops.h"

namespace catena::ranks {
namespace {

/// Where a block comes in space. Blocks of one code come in chain order, so that no two are equal.
struct Key {
  std::uint64_t code;
  SphereId first;
  friend auto operator<=>(const Key&, const Key&) = default;
};

/// Of a rank's spheres.
struct Where {
  CentreCorners corners;  ///< of some blocks
  std::uint64_t blocks;
};

/// By one of every so many blocks, as a look at all takes as long as to give each its code.
Where where_all_are(Communicator& ranks, const Part& part) {
  constexpr std::uint64_t most = 1 << 12;
  Where own{{}, blocks_of(part.pieces)};
  for_some_blocks(part.pieces, std::max<std::uint64_t>(1, own.blocks / most),
                  [&](const Block& block) { own.corners.take(middle_of(part.spheres, block)); });
  Where all{{}, 0};
  for (const Where& where : all_gather_value(ranks, own)) {
    all.corners.join(where.corners);
    all.blocks += where.blocks;
  }
  return all;
}

/// The part of a rank, and how its blocks come in space.
class BlocksInSpace {
 public:
  /// Blocks beyond these corners count as if on the nearest of their sides.
  BlocksInSpace(const Part& part, const CentreCorners& corners)
      : part_(part), corners_(corners), grid_(corners) {}

  Key key(const Block& block) const {
    const Piece& piece = part_.pieces[block.piece];
    return {grid_.code(corners_.nearest(middle_of(part_.spheres, block))),
            piece.first + (block.begin - piece.begin)};
  }

  /// Of every so many blocks the key, sorted: about one in sixteen, but no fewer and no more than these.
  std::vector<Key> some_keys(std::uint64_t blocks) const {
    constexpr std::uint64_t fewest = 1 << 12, most = 1 << 15;
    const std::uint64_t step = std::max<std::uint64_t>(1, blocks / std::clamp(blocks / 16, fewest, most));
    std::vector<Key> keys;
    for_some_blocks(part_.pieces, step, [&](const Block& block) { keys.push_back(key(block)); });
    std::ranges::sort(keys);
    return keys;
  }

 private:
  const Part& part_;
  const CentreCorners corners_;
  const MortonGrid grid_;
};

/// Of all keys after `low` up to `high` one that begins the largest cube: parts that end there have few
/// corners, and no block or two beyond the middle, for which a box around them would be twice as large.
Key coarsest(const Key& low, const Key& high) {
  if (low.code == high.code) return high;
  const std::uint64_t differs = std::bit_floor(low.code ^ high.code);
  return {high.code & ~(differs - 1), 0};
}

/// Keys that part the blocks of all ranks into about even shares, and lie between cubes as large as there are
/// within 1/64 of a share. Of a part of up to 4096 blocks all are looked at, and a share is off by no more
/// than that and one step a rank; of a larger one a sample of s, by which it is off by about 1 / sqrt(s) of
/// the part.
std::vector<Key> splitters(Communicator& ranks, const std::vector<Key>& sorted, std::uint64_t own_blocks,
                           std::uint64_t all_blocks) {
  constexpr std::uint64_t samples_a_rank = 256, parts_of_a_share = 64;
  const std::uint64_t step = std::max<std::uint64_t>(1, all_blocks / (samples_a_rank * ranks.size()));
  std::vector<Key> samples;
  for (std::uint64_t at = step / 2; at < own_blocks; at += step)
    samples.push_back(sorted[at * sorted.size() / own_blocks]);
  // Rank 0 chooses, as all would have to sort the samples of all otherwise.
  std::vector<Key> all, chosen;
  for (const Message& message : ranks.exchange({{0, ByteWriter().put_list(samples).take()}})) {
    const auto theirs = ByteReader(message.bytes).get_list<Key>();
    all.insert(all.end(), theirs.begin(), theirs.end());
  }
  std::ranges::sort(all);
  const std::uint64_t off = all.size() / (parts_of_a_share * ranks.size());
  for (unsigned rank = 1; rank < ranks.size() && !all.empty(); ++rank) {
    const std::uint64_t even = all.size() * rank / ranks.size();
    chosen.push_back(coarsest(all[even - off], all[even + off]));
  }
  const Gathered told = ranks.all_gather(ranks.rank() == 0 ? ByteWriter().put_list(chosen).take() : Bytes());
  return ByteReader(told->front()).get_list<Key>();
}

/// The rank that a key goes to; keys that follow one another mostly go to the same.
class Goal {
 public:
  explicit Goal(const std::vector<Key>& splitters) : splitters_(splitters) {}
  unsigned of(const Key& key) {
    if ((last_ > 0 && key < splitters_[last_ - 1]) || (last_ < splitters_.size() && key >= splitters_[last_]))
      last_ = static_cast<std::size_t>(std::ranges::upper_bound(splitters_, key) - splitters_.begin());
    return static_cast<unsigned>(last_);
  }

 private:
  const std::vector<Key>& splitters_;
  std::size_t last_ = 0;
};

std::vector<Share> shares_of(const Part& part, const BlocksInSpace& blocks, const std::vector<Key>& splitters,
                             unsigned ranks) {
  std::vector<Share> shares(ranks);
  Goal goal(splitters);
  for_each_block(part.pieces, [&](const Block& block) {
    const Key key = blocks.key(block);
    Share& share = shares[goal.of(key)];
    const bool goes_on = block.begin > part.pieces[block.piece].begin && !share.runs.empty() &&
                         share.runs.back().first + share.runs.back().size == key.first;
    if (goes_on) {
      share.runs.back().size += block.size;
    } else {
      share.runs.push_back({key.first, block.size, part.pieces[block.piece].strand});
      share.begin.push_back(block.begin);
    }
  });
  return shares;
}

/// The rows of these spheres.
std::span<const IdPair> rows_of(std::span<const IdPair> extra, SphereId first, std::uint64_t size) {
  const auto begin = std::ranges::lower_bound(extra, first, {}, &IdPair::i);
  const auto end = std::ranges::lower_bound(begin, extra.end(), first + size, {}, &IdPair::i);
  return {begin, end};
}

std::vector<IdPair> rows_of(const Part& part, const Share& share) {
  std::vector<IdPair> extra;
  if (part.extra.empty()) return extra;
  for (const Run& run : share.runs) {
    const auto rows = rows_of(part.extra, run.first, run.size);
    extra.insert(extra.end(), rows.begin(), rows.end());
  }
  return extra;
}

/// What a rank tells another of its share, but for what each sphere has.
Bytes packed(const Part& part, const Share& share) {
  return ByteWriter().put_list(share.runs).put_list(rows_of(part, share)).take();
}

/// Pieces of runs that follow one another: where one goes on with a strand it is the same piece.
void append_pieces(const std::vector<Run>& runs, std::vector<Piece>& pieces) {
  std::uint32_t begin = pieces.empty() ? 0 : pieces.back().begin + pieces.back().size;
  for (const Run& run : runs) {
    const auto size = static_cast<std::uint32_t>(run.size);
    Piece* const last = pieces.empty() ? nullptr : &pieces.back();
    if (last != nullptr && last->first + last->size == run.first && last->strand.first == run.strand.first)
      last->size += size;
    else
      pieces.push_back({run.first, begin, size, run.strand});
    begin += size;
  }
}

std::uint64_t spheres_of(const std::vector<Run>& runs) {
  std::uint64_t spheres = 0;
  for (const Run& run : runs) spheres += run.size;
  return spheres;
}

/// What the part is of when its spheres have moved: what stays and what comes, by rising ranks and so by
/// rising spheres. Returns how many come of each rank, of this one how many stay.
std::vector<std::uint64_t> take_over(Part& part, const Share& stays, std::vector<IdPair> extra,
                                     const std::vector<Message>& messages, const Communicator& ranks) {
  part.pieces.clear();
  part.extra = std::move(extra);
  std::vector<std::uint64_t> coming(ranks.size(), 0);
  const auto take = [&](unsigned rank, const std::vector<Run>& runs) {
    append_pieces(runs, part.pieces);
    coming[rank] = spheres_of(runs);
  };
  bool stayed_done = false;
  for (const Message& message : messages) {
    if (message.rank > ranks.rank() && !std::exchange(stayed_done, true)) take(ranks.rank(), stays.runs);
    ByteReader in(message.bytes);
    take(message.rank, in.get_list<Run>());
    const auto theirs = in.get_list<IdPair>();
    part.extra.insert(part.extra.end(), theirs.begin(), theirs.end());
  }
  if (!stayed_done) take(ranks.rank(), stays.runs);
  std::ranges::sort(part.extra);
  return coming;
}

/// The most that any rank takes to send its blocks, so many at a time; 0: a sixteenth of them, at least 2^14.
std::uint64_t rounds_of(Communicator& ranks, std::uint64_t blocks, std::uint64_t blocks_at_once) {
  constexpr std::uint64_t fewest = 1 << 14, rounds = 16;
  const std::uint64_t at_once =
      blocks_at_once > 0 ? blocks_at_once : std::max(fewest, (blocks + rounds - 1) / rounds);
  return std::ranges::max(all_gather_value(ranks, (blocks + at_once - 1) / at_once));
}

}  // namespace

double touching_share(Communicator& ranks, const Part& part) {
  constexpr std::uint64_t most = 1 << 12, of_all = 1 << 12, of_a_rank = 16;
  const std::uint64_t blocks = blocks_of(part.pieces);
  std::vector<Box> boxes;
  for_some_blocks(part.pieces, std::max<std::uint64_t>(1, blocks / most), [&](const Block& block) {
    boxes.push_back(box_around(std::span(part.spheres).subspan(block.begin, block.size)));
  });
  const Tops tops = Tops::of_all(ranks, boxes);
  const ForeignTops foreign(tops, ranks.rank());
  const std::size_t step =
      std::max<std::size_t>(1, boxes.size() / std::max(of_a_rank, of_all / ranks.size()));
  double looked_at = 0, touching = 0;
  for (std::size_t b = step / 2; b < boxes.size(); b += step) {
    ++looked_at;
    if (foreign.any()) foreign.for_each_rank(boxes[b], [&](unsigned) { ++touching; });
  }
  struct Count {
    double touching, blocks;
  } own{0, static_cast<double>(blocks)}, all{0, 0};
  if (looked_at > 0) own.touching = own.blocks * touching / looked_at;
  for (const Count& count : all_gather_value(ranks, own))
    all.touching += count.touching, all.blocks += count.blocks;
  return all.blocks == 0 ? 0 : all.touching / all.blocks;
}

Part part_in_space(Communicator& ranks, Part part, std::uint32_t blocks_at_once) {
  const Where all = where_all_are(ranks, part);
  const std::uint64_t own_blocks = blocks_of(part.pieces);
  std::vector<Share> shares;
  {
    const BlocksInSpace blocks(part, all.corners);
    const std::vector<Key> chosen = splitters(ranks, blocks.some_keys(own_blocks), own_blocks, all.blocks);
    shares = shares_of(part, blocks, chosen, ranks.size());
  }
  std::vector<Message> out;
  for (unsigned rank = 0; rank < ranks.size(); ++rank)
    if (rank != ranks.rank() && !shares[rank].runs.empty()) out.push_back({rank, packed(part, shares[rank])});
  const Share& stays = shares[ranks.rank()];
  const std::vector<std::uint64_t> coming =
      take_over(part, stays, rows_of(part, stays), ranks.exchange(std::move(out)), ranks);
  const std::uint64_t rounds = rounds_of(ranks, own_blocks, blocks_at_once);
  move_shares(ranks, shares, coming, rounds, part.spheres);
  if (part.rule.kind == Exclusion::Rule::arc_window) move_shares(ranks, shares, coming, rounds, part.arcs);
  return part;
}

}  // namespace catena::ranks
