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
/// starts: of each perturbed start {seed, outcome, failed_at, energy_drift, contacts, missed, invented};
/// searches, contacts, missed_by_variant, invented_by_variant: against the exact reference on the same stored
/// chains; reference_step, reference_contacts, missed_against_fine_step: against the fine motion, by
/// FrameComparison; ms_median, ms_lower, ms_upper: median and quartiles of ms, the wall time of the whole
/// motion in each repetition; find_ms: the least time in the variant.
nlohmann::ordered_json to_json(const MotionRow& row);

/// The share of starts that fail, with its 95 % interval (Wilson 1927).
struct FailingShare {
  double value = 0, low = 0, high = 1;
};
FailingShare failing_share(const std::vector<MotionStart>& starts);

/// Prints one line a row, and before the first one the heads of the columns.
class MotionTable {
 public:
  void print(const MotionRow& row);

 private:
  bool begun_ = false;
};

/// At which stiffness and step each variant fails, in words, a line for each variant and offset: the first
/// start, and the share of the perturbed starts that fail with its interval. Its arithmetic is at fault only
/// where that interval lies above the one of an exact variant of the same rows.
std::vector<std::string> motion_verdicts(const std::vector<MotionRow>& rows);

}  // namespace catena::bench
