#include "catena/core/grid/told_radii.h"

namespace catena {

Decision told_radii(bool equal) {
  return {"radius of each sphere in cells", equal,
          equal ? "all radii are equal" : "radii differ, or are read one by one, or nothing is in cells"};
}

ParameterInfo radii_parameter() {
  return {"radii", "once", "radii that are all equal are read once, or each"};
}

bool reads_each_radius(const Parameters& parameters) {
  return parameters.choice("radii", {"once", "each"}) == "each";
}

}  // namespace catena
