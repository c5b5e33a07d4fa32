#include "catena/core/parts/part_as_chain.h"

#include <utility>
#include <vector>

namespace catena::parts {

Chain part_as_chain(const Chain& whole, const LocalChain& part) {
  std::vector<Sphere> spheres;
  for (const SphereRange& run : part.runs())
    spheres.insert(spheres.end(), whole.spheres().begin() + run.begin, whole.spheres().begin() + run.end);
  Strands strands{{0}, {}};
  for (const LocalChain::Piece& piece : part.pieces())
    strands.first.push_back(piece.begin + piece.size), strands.closed.push_back(piece.closed);
  if (part.pieces().empty()) strands = {};
  Exclusion exclusion = whole.exclusion();
  exclusion.extra_pairs.assign(part.extra().begin(), part.extra().end());
  if (exclusion.rule == Exclusion::Rule::index_window)
    return Chain(std::move(spheres), std::move(strands), std::move(exclusion));
  const ExclusionView rule = whole.view().exclusion;
  ArcLengths arcs;
  for (const LocalChain::Piece& piece : part.pieces()) {
    arcs.arc.insert(arcs.arc.end(), rule.arc + piece.first, rule.arc + piece.first + piece.size);
    arcs.loop_length.push_back(rule.loop_length[piece.strand]);
  }
  if (part.pieces().empty()) arcs.loop_length.push_back(0);
  return Chain(std::move(spheres), std::move(strands), std::move(exclusion), std::move(arcs));
}

}  // namespace catena::parts
