#include "catena/core/blocks/told_rows.h"

#include <fmt/format.h>

#include "catena/core/counted.h"

namespace catena {

Decision told_rows(const BlockTree& tree, const Crowding* crowding) {
  const std::uint32_t rows = tree.rows(), nodes = tree.level.empty() ? 0 : tree.level[0].count;
  std::uint64_t pairs = 0;  // but for those of blocks next to one another, which are searched
  for (std::uint32_t k = 0; rows > 0 && k < nodes; ++k) {
    if (!tree.in_a_row(0, k) || (crowding != nullptr && crowding->crowded(k))) continue;
    const std::uint64_t blocks = tree.blocks_of(k);
    pairs += blocks < 2 ? 0 : (blocks - 1) * (blocks - 2) / 2;
  }
  return {"search within straight stretches",
          rows > 0,
          nodes == 0 ? "too few spheres for a node of 128"
                     : fmt::format("in {} of {} nodes of 128 spheres blocks follow one another along an axis",
                                   rows, nodes),
          std::nullopt,
          std::nullopt,
          pairs > 0 ? counted(pairs, "pair") + " of blocks of 8 spheres" : ""};
}

ParameterInfo rows_parameter() {
  return {"rows", "skip", "nodes whose blocks follow one another along an axis: skip or search them"};
}

bool skips_rows(const Parameters& parameters) {
  return parameters.choice("rows", {"skip", "search"}) == "skip";
}

}  // namespace catena
