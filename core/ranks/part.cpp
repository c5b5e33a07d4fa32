#include "catena/core/ranks/part.h"

#include <algorithm>

namespace catena::ranks {

Part part_of(const Chain& chain, std::uint32_t first, std::uint32_t end) {
  const Exclusion& exclusion = chain.exclusion();
  const ChainView view = chain.view();
  const bool arcs = exclusion.rule == Exclusion::Rule::arc_window;
  Part part;
  part.rule = {exclusion.rule, exclusion.window, exclusion.factor};
  part.spheres.assign(chain.spheres().begin() + first, chain.spheres().begin() + end);
  if (arcs) part.arcs.assign(view.exclusion.arc + first, view.exclusion.arc + end);

  const auto& starts = chain.strands().first;
  auto s = static_cast<std::size_t>(std::ranges::upper_bound(starts, first) - starts.begin());
  for (std::uint32_t at = first; at < end; ++s) {
    const std::uint32_t strand = static_cast<std::uint32_t>(s - 1), stop = std::min(end, starts[s]);
    if (stop == at) continue;
    const bool closed = chain.strands().closed[strand] != 0;
    part.pieces.push_back({at,
                           at - first,
                           stop - at,
                           {starts[strand], starts[s] - starts[strand],
                            arcs && closed ? view.exclusion.loop_length[strand] : 0, closed, strand}});
    at = stop;
  }

  if (view.exclusion.extra_row == nullptr) return part;
  for (std::uint32_t i = first; i < end; ++i)
    for (std::uint32_t k = view.exclusion.extra_row[i]; k < view.exclusion.extra_row[i + 1]; ++k)
      part.extra.push_back({i, view.exclusion.extra[k]});
  std::ranges::sort(part.extra);
  return part;
}

}  // namespace catena::ranks
