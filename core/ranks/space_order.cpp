#include "catena/core/ranks/space_order.h"

#include <algorithm>

#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/ranks/block_message.h"

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
  CentreCorners corners;
  std::uint64_t blocks;
};

Where where_all_are(Communicator& ranks, const HeldPart& part) {
  Where own{{}, part.blocks().size()};
  for (const Sphere& s : part.chain().spheres()) own.corners.take(s);
  Where all{{}, 0};
  for (const Where& where : all_gather_value(ranks, own)) {
    all.corners.join(where.corners);
    all.blocks += where.blocks;
  }
  return all;
}

/// A block and where it comes.
struct Keyed {
  Key key;
  std::uint32_t block;
};

/// Keys that part the blocks of all ranks into even shares: those of every so many blocks, by which a share
/// is off by no more than one step a rank.
std::vector<Key> splitters(Communicator& ranks, const std::vector<Keyed>& sorted, std::uint64_t all_blocks) {
  constexpr std::uint64_t samples_a_rank = 64;
  const std::uint64_t step = std::max<std::uint64_t>(1, all_blocks / (samples_a_rank * ranks.size()));
  std::vector<Key> samples;
  for (std::uint64_t at = step / 2; at < sorted.size(); at += step) samples.push_back(sorted[at].key);
  std::vector<Key> all;
  const Gathered gathered = ranks.all_gather(ByteWriter().put_list(samples).take());
  for (const Bytes& bytes : *gathered) {
    const auto theirs = ByteReader(bytes).get_list<Key>();
    all.insert(all.end(), theirs.begin(), theirs.end());
  }
  std::ranges::sort(all);
  std::vector<Key> chosen;
  for (unsigned rank = 1; rank < ranks.size(); ++rank)
    if (!all.empty()) chosen.push_back(all[all.size() * rank / ranks.size()]);
  return chosen;
}

std::vector<Keyed> keyed_blocks(const HeldPart& part, const MortonGrid& grid) {
  std::vector<Keyed> keyed;
  for (std::uint32_t b = 0; b < part.blocks().size(); ++b) {
    const Block& block = part.blocks()[b];
    keyed.push_back({{grid.code(part.spheres(block)[block.size / 2]), part.id(block)}, b});
  }
  std::ranges::sort(keyed, {}, &Keyed::key);
  return keyed;
}

std::vector<Message> shares_of(const HeldPart& part, const std::vector<Keyed>& sorted,
                               const std::vector<Key>& splitters, unsigned ranks) {
  std::vector<Message> shares;
  auto at = sorted.begin();
  for (unsigned rank = 0; rank < ranks && at != sorted.end(); ++rank) {
    const auto end = rank < splitters.size()
                         ? std::ranges::lower_bound(at, sorted.end(), splitters[rank], {}, &Keyed::key)
                         : sorted.end();
    ByteWriter out;
    for (; at != end; ++at) put_block(out, part, part.blocks()[at->block], ExtraPairs::sent);
    if (out.size() > 0) shares.push_back({rank, out.take()});
  }
  return shares;
}

std::vector<FarBlock> blocks_in(std::vector<Message> messages, const Rule& rule) {
  std::vector<FarBlock> blocks;
  for (Message& message : messages) {
    for (ByteReader in(message.bytes); !in.empty();) blocks.push_back(get_block(in, rule));
    Bytes().swap(message.bytes);
  }
  return blocks;
}

/// Blocks that follow one another on a strand, by their numbers here.
struct Run {
  std::size_t begin, end;
  Key key;
};

std::vector<Run> runs_in_space(const std::vector<FarBlock>& blocks, const MortonGrid& grid) {
  std::vector<Run> runs;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const FarBlock& block = blocks[b];
    const bool goes_on = b > 0 && blocks[b - 1].first + blocks[b - 1].size == block.first &&
                         blocks[b - 1].strand.first == block.strand.first;
    if (goes_on)
      ++runs.back().end;
    else
      runs.push_back({b, b + 1, {grid.code(block.spheres[block.size / 2]), block.first}});
  }
  std::ranges::sort(runs, {}, &Run::key);
  return runs;
}

Part part_of(std::vector<FarBlock> blocks, const Rule& rule, const MortonGrid& grid) {
  std::ranges::sort(blocks, {}, &FarBlock::first);
  Part part;
  part.rule = rule;
  for (const Run& run : runs_in_space(blocks, grid)) {
    const auto begin = static_cast<std::uint32_t>(part.spheres.size());
    for (const FarBlock& block : std::span(blocks).subspan(run.begin, run.end - run.begin)) {
      part.spheres.insert(part.spheres.end(), block.spheres.begin(), block.spheres.begin() + block.size);
      if (rule.kind == Exclusion::Rule::arc_window)
        part.arcs.insert(part.arcs.end(), block.arcs.begin(), block.arcs.begin() + block.size);
      part.extra.insert(part.extra.end(), block.extra.begin(), block.extra.end());
    }
    part.pieces.push_back({blocks[run.begin].first, begin,
                           static_cast<std::uint32_t>(part.spheres.size()) - begin,
                           blocks[run.begin].strand});
  }
  std::ranges::sort(part.extra);
  return part;
}

}  // namespace

double touching_share(Communicator& ranks, const HeldPart& part, const Tops& tops) {
  const std::size_t blocks = part.blocks().size();
  const std::size_t looked_at =
      std::max<std::size_t>(16, (std::size_t{1} << 22) / (Tops::most * ranks.size()));
  const std::size_t step = std::max<std::size_t>(1, blocks / looked_at);
  struct Share {
    double touching, blocks;
  } own{0, static_cast<double>(blocks)};
  for (std::size_t b = step / 2; b < blocks; b += step) {
    const Box box = part.boxes().box(static_cast<std::uint32_t>(b));
    for (unsigned other = 0; other < ranks.size(); ++other)
      if (other != ranks.rank() && tops.meets(other, box)) own.touching += static_cast<double>(step);
  }
  Share all{0, 0};
  for (const Share& share : all_gather_value(ranks, own))
    all.touching += share.touching, all.blocks += share.blocks;
  return all.blocks == 0 ? 0 : all.touching / all.blocks;
}

Part part_in_space(Communicator& ranks, const HeldPart& part) {
  const Where all = where_all_are(ranks, part);
  const MortonGrid grid(all.corners);
  std::vector<Message> shares;
  {
    const std::vector<Keyed> sorted = keyed_blocks(part, grid);
    shares = shares_of(part, sorted, splitters(ranks, sorted, all.blocks), ranks.size());
  }
  return part_of(blocks_in(ranks.exchange(std::move(shares)), part.rule()), part.rule(), grid);
}

}  // namespace catena::ranks
