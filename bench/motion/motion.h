#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/pair.h"

namespace catena::bench {

/// The motion that is measured: a rope of n spheres, radius 1, spacing 1, with a loose overhand knot, that a
/// force of 1 pulls at both ends. See core/motion/rope.h for the units.
struct MotionCase {
  double stiffness = 1e4;  ///< tension at a strain of 1, over the force that pulls
  double step = 0.5;       ///< at most; a whole number of steps makes a frame
  double offset = 0;       ///< of the stored chain from the origin on every axis, in radii
  std::string variant;     ///< finds the contacts
  std::uint32_t n = 120, frames = 51;
  double duration = 100;
  std::uint64_t seed = 1;  ///< of the small velocities at the start: another one is a perturbed start

  bool exact() const;  ///< the variant must not miss a contact
};

enum class MotionOutcome {
  holds,    ///< the knot is there to the end
  slipped,  ///< the rope passed through itself: the knot is another, or none
  diverged  ///< a step had no solution
};
std::string name_of(MotionOutcome outcome);

/// What came of it.
struct MotionResult {
  MotionOutcome outcome = MotionOutcome::holds;
  std::optional<double> failed_at;  ///< time at which it first slipped, or diverged
  /// Greatest |kinetic + elastic + contact - initial - work of the ends + dissipated by drag| after any step,
  /// over the initial energy and the greatest work: what the integrator lost or won, and what contacts found
  /// too late, not at all or wrongly brought in.
  double energy_drift = 0;
  double deepest_penetration =
      0;  ///< of any two spheres after any step, found or not, over the radius; 2: same place
  double greatest_strain = 0;              ///< of an edge after any step
  std::uint64_t searches = 0;              ///< of the variant: one for the start and one a step
  std::uint64_t contacts = 0;              ///< exact pairs of the chains that it was given, over all searches
  std::uint64_t missed = 0, invented = 0;  ///< of those, by the variant
  std::vector<std::vector<Pair>> frame_contacts;  ///< what it found in each frame reached
  std::vector<double> ms;                         ///< wall time of the whole motion, each repetition
  double find_ms = 0;                             ///< least time in the variant of these
};

/// Runs the motion once and holds every search against the exact reference on the same stored chain.
MotionResult measure_motion(const MotionCase& motion);

/// What came of one start of a motion that was begun several times.
struct MotionStart {
  std::uint64_t seed = 0;
  MotionOutcome outcome = MotionOutcome::holds;
  std::optional<double> failed_at;
  double energy_drift = 0;
  std::uint64_t contacts = 0, missed = 0, invented = 0;  ///< as in MotionResult
};

/// The same motion from `starts` perturbed starts, seeds 1, 2, ...: near a knife edge one motion says
/// nothing, the share that slips does. On all cores.
std::vector<MotionStart> measure_starts(const MotionCase& motion, std::size_t starts);

/// Runs each motion again, `repetitions` times, without any check, interleaved in a fresh random order each
/// round, and adds the times.
void time_motions(const std::vector<MotionCase>& motions, std::vector<MotionResult>& results,
                  std::size_t repetitions);

/// Contacts of the frames of a fine motion, and how many of them the other has not: neither that pair in that
/// frame, nor one of spheres at most `near_along` along the rope from both. A frame that was not reached has
/// none.
struct FrameComparison {
  static constexpr std::uint32_t near_along = 2;
  std::uint64_t contacts = 0, missed = 0;
};
FrameComparison compare_frames(const std::vector<std::vector<Pair>>& fine,
                               const std::vector<std::vector<Pair>>& other);

/// A motion, what came of it, and its contacts against those of the fine motion of the same stiffness.
struct MotionRow {
  MotionCase motion;
  MotionResult result;
  double reference_step = 0;
  FrameComparison against_fine;
  std::vector<MotionStart> starts;  ///< the motion from each perturbed start, its own seed among them
};

/// Measures each motion, then times them all against each other (time_motions); `fine` is the exact motion of
/// their stiffness at `reference_step`. Each is begun from `starts` perturbed starts besides.
std::vector<MotionRow> measure_motions(const std::vector<MotionCase>& motions, const MotionResult& fine,
                                       double reference_step, std::size_t repetitions, std::size_t starts);

}  // namespace catena::bench
