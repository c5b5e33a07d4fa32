#include "catena/core/ranks/part.h"

#include <algorithm>
#include <span>

namespace catena::ranks {

namespace {

/// The strands that spheres first, ..., end - 1 are of; `loop_length`: one a strand, or none.
std::vector<Piece> pieces_of(const Strands& strands, std::span<const double> loop_length, std::uint32_t first,
                             std::uint32_t end) {
  std::vector<Piece> pieces;
  const auto& starts = strands.first;
  auto s = static_cast<std::size_t>(std::ranges::upper_bound(starts, first) - starts.begin());
  for (std::uint32_t at = first; at < end; ++s) {
    const std::uint32_t strand = static_cast<std::uint32_t>(s - 1), stop = std::min(end, starts[s]);
    if (stop == at) continue;
    const bool closed = !strands.closed.empty() && strands.closed[strand] != 0;
    pieces.push_back({at,
                      at - first,
                      stop - at,
                      {starts[strand], starts[s] - starts[strand],
                       closed && !loop_length.empty() ? loop_length[strand] : 0, closed, strand}});
    at = stop;
  }
  return pieces;
}

}  // namespace

Part part_of(const Chain& chain, std::uint32_t first, std::uint32_t end) {
  const Exclusion& exclusion = chain.exclusion();
  const ChainView view = chain.view();
  const bool arcs = exclusion.rule == Exclusion::Rule::arc_window;
  Part part;
  part.rule = {exclusion.rule, exclusion.window, exclusion.factor};
  part.spheres.assign(chain.spheres().begin() + first, chain.spheres().begin() + end);
  if (arcs) part.arcs.assign(view.exclusion.arc + first, view.exclusion.arc + end);
  const std::span loops(view.exclusion.loop_length, arcs ? chain.strand_count() : 0);
  part.pieces = pieces_of(chain.strands(), loops, first, end);

  if (view.exclusion.extra_row == nullptr) return part;
  for (std::uint32_t i = first; i < end; ++i)
    for (std::uint32_t k = view.exclusion.extra_row[i]; k < view.exclusion.extra_row[i + 1]; ++k)
      part.extra.push_back({i, view.exclusion.extra[k]});
  std::ranges::sort(part.extra);
  return part;
}

Part part_of(const ChainByStretches& chain, std::uint32_t first, std::uint32_t end) {
  Part part;
  part.rule = {chain.exclusion.rule, chain.exclusion.window, chain.exclusion.factor};
  part.spheres = chain.spheres(first, end);
  const Strands one{{0, chain.size}, {}};
  part.pieces = pieces_of(chain.strands.first.empty() ? one : chain.strands, {}, first, end);
  return part;
}

}  // namespace catena::ranks
