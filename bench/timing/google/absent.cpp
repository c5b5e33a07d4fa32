#include "catena/bench/timing/google/rounds.h"
#include "catena/core/error.h"

namespace catena::bench {

Rounds measure_in_rounds(const std::vector<Case>&, const Stopping&, const RowTaker&,
                         const nlohmann::ordered_json&) {
  throw InputError(
      "this catena was built without Google Benchmark and cannot measure: install libbenchmark-dev, then "
      "configure and "
      "build again; --from RUN.json makes a page of what was measured elsewhere");
}

}  // namespace catena::bench
