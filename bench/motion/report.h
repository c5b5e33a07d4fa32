#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "catena/bench/motion/motion.h"

namespace catena::bench {

/// One row as a JSON object:
/// stiffness, step, offset, n, frames, duration: the MotionCase; variant, arithmetic: who found the contacts;
/// outcome: "holds", "slipped" or "diverged"; failed_at: the time of that, null when it holds;
/// energy_drift, deepest_penetration, greatest_strain: see MotionResult ("infinite" when not finite);
/// searches, contacts, missed_by_variant, invented_by_variant: against the exact reference on the same stored
/// chains; reference_step, reference_contacts, missed_against_fine_step: against the fine motion, by
/// FrameComparison; ms_median, ms_lower, ms_upper: median and quartiles of ms, the wall time of the whole
/// motion in each repetition; find_ms: the least time in the variant.
nlohmann::ordered_json to_json(const MotionRow& row);

/// Prints one line a row, and before the first one the heads of the columns.
class MotionTable {
 public:
  void print(const MotionRow& row);

 private:
  bool begun_ = false;
};

/// At which stiffness and step each variant fails, in words, a line for each variant and offset; and where
/// its arithmetic is at fault, because an exact variant of the same rows holds there.
std::vector<std::string> motion_verdicts(const std::vector<MotionRow>& rows);

}  // namespace catena::bench
