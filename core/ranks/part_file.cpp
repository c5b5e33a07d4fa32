#include "catena/core/ranks/part_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

std::vector<Piece> pieces_of(const BinaryChain& file, SphereId begin, SphereId end) {
  std::vector<Piece> pieces;
  SphereId at = begin;
  file.for_each_strand(begin, end, [&](std::uint64_t number, const BinaryChain::Extent& extent) {
    const auto& [strand, stop] = extent;
    const SphereId last = std::min(end, stop);
    pieces.push_back({at,
                      static_cast<std::uint32_t>(at - begin),
                      static_cast<std::uint32_t>(last - at),
                      {strand.first, stop - strand.first, strand.loop_length, strand.closed, number}});
    at = last;
  });
  return pieces;
}

/// Both ways of each extra pair, to the ranks of both ends.
std::vector<IdPair> extra_pairs(Communicator& ranks, const BinaryChain& file,
                                const std::vector<SphereId>& starts) {
  std::vector<IdPair> own;
  std::vector<std::vector<IdPair>> back(ranks.size());
  for (const auto& [i, j] : file.pairs(starts[ranks.rank()], starts[ranks.rank() + 1])) {
    own.push_back({i, j});
    back[static_cast<std::size_t>(std::ranges::upper_bound(starts, j) - starts.begin()) - 1].push_back(
        {j, i});
  }
  std::vector<Message> out;
  for (unsigned rank = 0; rank < ranks.size(); ++rank)
    if (!back[rank].empty()) out.push_back({rank, ByteWriter().put_list(back[rank]).take()});
  for (const Message& message : ranks.exchange(std::move(out))) {
    const auto theirs = ByteReader(message.bytes).get_list<IdPair>();
    own.insert(own.end(), theirs.begin(), theirs.end());
  }
  std::ranges::sort(own);
  return own;
}

}  // namespace

Part read_part(Communicator& ranks, const BinaryChain& file) {
  const SphereId n = file.header().spheres;
  std::vector<SphereId> starts;
  for (unsigned rank = 0; rank <= ranks.size(); ++rank) starts.push_back(even_start(n, ranks.size(), rank));
  const SphereId begin = starts[ranks.rank()], end = starts[ranks.rank() + 1];
  if (end - begin >= SphereId{1} << 31)
    throw InputError(fmt::format("{} spheres are too many for {} ranks; take more ranks", n, ranks.size()));
  // All strands, shared out: where they do not ascend, none finds all of those that are its own.
  const auto strands = [&](unsigned rank) { return even_start(file.header().strands, ranks.size(), rank); };
  file.require_strands(strands(ranks.rank()), strands(ranks.rank() + 1));
  ranks.vote();
  const Exclusion rule = file.rule();
  Part part;
  part.rule = {rule.rule, rule.window, rule.factor};
  part.spheres = file.spheres(begin, end);
  part.pieces = pieces_of(file, begin, end);
  if (rule.rule == Exclusion::Rule::arc_window) {
    part.arcs = file.arcs(begin, end);
    file.require_measured(begin, part.spheres, part.arcs);
  }
  part.extra = extra_pairs(ranks, file, starts);
  return part;
}

}  // namespace catena::ranks
