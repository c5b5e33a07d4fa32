#include "catena/core/executor/usable_cores.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>

namespace catena {

unsigned usable_cores() {
  using oneapi::tbb::global_control;
  const auto allowed = global_control::active_value(global_control::max_allowed_parallelism);
  const auto given = static_cast<std::size_t>(std::max(1, oneapi::tbb::info::default_concurrency()));
  return static_cast<unsigned>(std::clamp<std::size_t>(allowed, 1, given));
}

struct CoreLimit::Control {
  explicit Control(unsigned cores)
      : limit(oneapi::tbb::global_control::max_allowed_parallelism, std::max(1u, cores)) {}
  oneapi::tbb::global_control limit;
};

CoreLimit::CoreLimit(unsigned cores) : control_(std::make_unique<Control>(cores)) {}
CoreLimit::~CoreLimit() = default;

}  // namespace catena
