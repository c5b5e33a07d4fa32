#include "catena/properties/fuzz/fault.h"

#include <algorithm>

#include "catena/core/strategy/timings.h"
#include "catena/properties/fuzz/sequence.h"
#include "catena/properties/fuzz/watched.h"
#include "catena/properties/generators/simplifications.h"

namespace catena::properties {

ShrunkFault shrink_fault(const Finding& finding, Chain chain, std::vector<Chain> before, double timeout,
                         double seconds) {
  constexpr double least_timeout = 1;  // seconds: starting a process on a busy machine is no hang
  const Stopwatch watch;
  const auto dies = [&](const auto& work) {
    if (watch.ms() > 1000 * seconds) return false;
    Notebook notebook;
    const Ending ending = tried(notebook, timeout > 0 ? std::max(timeout, least_timeout) : 0, [&] {
      work(Subject::named(finding.variant),
           Suite::Watch([&](const Subject& subject, const Property& property) {
             notebook.check(subject.info.name, property.name());
           }));
      return 0;
    });
    return !ending.fault.empty();
  };
  const auto fails = [&](const Chain& simpler) {
    return dies([&](const Subject& subject, const auto&) { Suite({subject}).repeats(finding, simpler); });
  };
  if (fails(chain)) return {{shrink(std::move(chain), fails)}, true};
  before.push_back(chain);
  auto sequence = shortest_sequence(std::move(before), [&](const std::vector<Chain>& some) {
    return dies([&](const Subject& subject, const Suite::Watch& beats) {
      fails_in_sequence(subject, finding.property, some, beats);
    });
  });
  if (!sequence) return {{std::move(chain)}, false};
  return {std::move(*sequence), true};
}

}  // namespace catena::properties
