#include "catena/core/grid/told_radii.h"

#include "catena/core/counted.h"

namespace catena {

Decision told_radii(bool equal, std::uint64_t spheres) {
  return {"radius of each sphere in cells",
          equal,
          equal ? "all radii are equal" : "radii differ, or are read one by one, or nothing is in cells",
          std::nullopt,
          std::nullopt,
          equal ? "radii of " + counted(spheres, "sphere") : ""};
}

ParameterInfo radii_parameter() {
  return {"radii", "once", "radii that are all equal are read once, or each"};
}

bool reads_each_radius(const Parameters& parameters) {
  return parameters.choice("radii", {"once", "each"}) == "each";
}

}  // namespace catena
