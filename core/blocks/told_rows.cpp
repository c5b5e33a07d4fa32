#include "catena/core/blocks/told_rows.h"

#include <fmt/format.h>

namespace catena {

Decision told_rows(std::uint32_t rows, std::uint32_t nodes) {
  return {"search within straight stretches", rows > 0,
          nodes == 0 ? "too few spheres for a node of 128"
                     : fmt::format("in {} of {} nodes of 128 spheres blocks follow one another along an axis",
                                   rows, nodes)};
}

ParameterInfo rows_parameter() {
  return {"rows", "skip", "nodes whose blocks follow one another along an axis: skip or search them"};
}

bool skips_rows(const Parameters& parameters) {
  return parameters.choice("rows", {"skip", "search"}) == "skip";
}

}  // namespace catena
