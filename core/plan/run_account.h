#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/timings.h"
#include "catena/core/strategy/work_done.h"

namespace catena {

/// What a run of a plan took and met, as far as it was measured.
struct CATENA_API RunAccount {
  std::uint32_t spheres = 0;
  Timings took;                             ///< of build and find together
  std::optional<double> planning_ms;        ///< of choosing
  std::optional<double> planning_again_ms;  ///< once more: a first time in a process also starts threads
  std::optional<double> look_ms;            ///< at likely places
  std::optional<std::uint64_t> unlisted;    ///< pairs that were counted and not kept
  struct Searcher {
    std::string name;
    bool all_pairs = false;
    Timings took;
    std::vector<WorkDone> work;
  };
  std::optional<Searcher> searcher;  ///< who built and searched; none where nothing was built
};

/// Says beside the steps of a plan what each took, and adds those that take time but were no choice:
/// planning, build, search, moves between memories.
CATENA_API void tell_run(const RunAccount& run, Plan& steps);

}  // namespace catena
