#include "catena/properties/fuzz/fault.h"

#include <algorithm>

#include "catena/core/strategy/timings.h"
#include "catena/properties/fuzz/watched.h"
#include "catena/properties/generators/simplifications.h"

namespace catena::properties {

ShrunkFault shrink_fault(const Finding& finding, Chain chain, double timeout, double seconds) {
  constexpr double least_timeout = 1;  // seconds: starting a process on a busy machine is no hang
  const Stopwatch watch;
  const auto fails = [&](const Chain& simpler) {
    if (watch.ms() > 1000 * seconds) return false;
    Notebook notebook;
    const Ending ending = tried(notebook, timeout > 0 ? std::max(timeout, least_timeout) : 0, [&] {
      Suite({Subject::named(finding.variant)}).repeats(finding, simpler);
      return 0;
    });
    return !ending.fault.empty();
  };
  if (!fails(chain)) return {std::move(chain), false};
  return {shrink(std::move(chain), fails), true};
}

}  // namespace catena::properties
