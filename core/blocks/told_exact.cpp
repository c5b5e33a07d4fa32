#include "catena/core/blocks/told_exact.h"

#include <fmt/format.h>

#include "catena/core/counted.h"

namespace catena {

Decision told_exact(std::uint64_t open, float doubt) {
  return {"exact stage where binary32 is certain", doubt == 1,
          doubt == 1 ? fmt::format("it was of all but {} of spheres", counted(open, "pair"))
                     : fmt::format("{} of spheres decided beyond binary32, whether it was or not",
                                   counted(open, "pair"))};
}

ParameterInfo exact_parameter() {
  return {"exact", "open",
          "pairs that are decided beyond binary32: those it leaves open, or all that it meets"};
}

float doubt_of(const Parameters& parameters) {
  constexpr float everything = 0x1p100f;  // no two spheres of a search are so far apart, in their radii
  return parameters.choice("exact", {"open", "all"}) == "all" ? everything : 1;
}

}  // namespace catena
