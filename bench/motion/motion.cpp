#include "catena/bench/motion/motion.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <thread>

#include "catena/bench/motion/knot_determinant.h"
#include "catena/bench/timing/sampling.h"
#include "catena/core/error.h"
#include "catena/core/executor/startable_threads.h"
#include "catena/core/motion/knot.h"
#include "catena/core/motion/rope.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

motion::RopeMotion start(const MotionCase& c) {
  motion::RopeSettings settings;
  settings.stretching = c.stiffness;
  motion::RopeMotion::Start start;
  Random random(c.seed);
  motion::add_knotted_rope(start, c.n, settings.spacing, {}, random);
  const auto place = [offset = c.offset](const Vec3& p) {
    return Sphere{static_cast<float>(p.x + offset), static_cast<float>(p.y + offset),
                  static_cast<float>(p.z + offset), 1};
  };
  return {settings, start, place, StrategyRegistry::instance().make(c.variant)};
}

/// Steps through the motion; `after_step(time)` after each, `after_frame()` at the end of each frame. Returns
/// when it diverged, if it did.
template <class AfterStep, class AfterFrame>
std::optional<double> play(const MotionCase& c, motion::RopeMotion& rope, const AfterStep& after_step,
                           const AfterFrame& after_frame) {
  if (c.frames < 2) return {};
  const double interval = c.duration / (c.frames - 1);
  const auto steps = static_cast<std::uint64_t>(std::ceil(interval / c.step * (1 - 1e-12)));
  const double dt = interval / static_cast<double>(steps);
  for (std::uint32_t f = 1; f < c.frames; ++f) {
    for (std::uint64_t s = 0; s < steps; ++s) {
      const double time = (f - 1) * interval + static_cast<double>(s + 1) * dt;
      if (!rope.step(dt)) return time;
      after_step(time);
    }
    after_frame();
  }
  return {};
}

}  // namespace

std::string name_of(MotionOutcome outcome) {
  switch (outcome) {
    case MotionOutcome::holds:
      return "holds";
    case MotionOutcome::slipped:
      return "slipped";
    case MotionOutcome::diverged:
      return "diverged";
  }
  return "";
}

bool MotionCase::exact() const { return StrategyRegistry::instance().describe(variant).exact; }

MotionResult measure_motion(const MotionCase& c) {
  MotionResult result;
  motion::RopeMotion rope = start(c);
  const std::uint64_t knot = knot_determinant(rope.positions());
  double greatest_error = 0, greatest_work = 0;
  const auto look = [&](double time) {
    const motion::EnergyBalance energy = rope.energy();
    greatest_error = std::max(greatest_error, std::abs(energy.error()));
    greatest_work = std::max(greatest_work, energy.work);
    result.deepest_penetration = std::max(result.deepest_penetration, rope.deepest_penetration());
    result.greatest_strain = std::max(result.greatest_strain, rope.greatest_strain());
    const auto exact = reference::find(rope.chain());
    std::vector<Pair> common;
    std::ranges::set_intersection(exact.pairs, rope.contacts(), std::back_inserter(common));
    ++result.searches;
    result.contacts += exact.pairs.size();
    result.missed += exact.pairs.size() - common.size();
    result.invented += rope.contacts().size() - common.size();
    if (!result.failed_at && knot_determinant(rope.positions()) != knot) {
      result.outcome = MotionOutcome::slipped;
      result.failed_at = time;
    }
  };
  const auto keep = [&] {
    result.frame_contacts.emplace_back(rope.contacts().begin(), rope.contacts().end());
  };
  look(0);
  keep();
  if (const auto diverged = play(c, rope, look, keep)) {
    result.outcome = MotionOutcome::diverged;
    result.failed_at = diverged;
  }
  result.energy_drift = greatest_error / (rope.energy().initial + greatest_work);
  return result;
}

std::vector<MotionStart> measure_starts(const MotionCase& motion, std::size_t starts) {
  std::vector<MotionStart> found(starts);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < starts; k = next++) {
      MotionCase perturbed = motion;
      perturbed.seed = k + 1;
      const MotionResult result = measure_motion(perturbed);
      found[k] = {perturbed.seed,  result.outcome, result.failed_at, result.energy_drift,
                  result.contacts, result.missed,  result.invented};
    }
  };
  std::vector<std::future<void>> workers;
  const unsigned others = startable_threads(std::max(1u, std::thread::hardware_concurrency()) - 1);
  for (unsigned k = 0; k < others; ++k) workers.push_back(std::async(std::launch::async, work));
  work();
  for (auto& worker : workers) worker.get();
  return found;
}

void time_motions(const std::vector<MotionCase>& motions, std::vector<MotionResult>& results,
                  std::size_t repetitions) {
  std::vector<double> least_find_ms(motions.size(), std::numeric_limits<double>::infinity());
  std::vector<std::function<double()>> runs;
  for (std::size_t k = 0; k < motions.size(); ++k)
    runs.emplace_back([&, k] {
      const Stopwatch watch;
      motion::RopeMotion rope = start(motions[k]);
      play(
          motions[k], rope, [](double) {}, [] {});
      least_find_ms[k] = std::min(least_find_ms[k], rope.find_ms());
      return watch.ms();
    });
  auto ms = interleave(runs, repetitions, std::numeric_limits<double>::infinity(), motions.size());
  for (std::size_t k = 0; k < motions.size() && repetitions > 0; ++k) {
    results[k].ms = std::move(ms[k]);
    results[k].find_ms = least_find_ms[k];
  }
}

FrameComparison compare_frames(const std::vector<std::vector<Pair>>& fine,
                               const std::vector<std::vector<Pair>>& other) {
  const auto near = [](std::uint32_t a, std::uint32_t b) {
    return (a < b ? b - a : a - b) <= FrameComparison::near_along;
  };
  FrameComparison comparison;
  for (std::size_t f = 0; f < fine.size(); ++f)
    for (const Pair& p : fine[f]) {
      ++comparison.contacts;
      const auto matches = [&](const Pair& q) { return near(p.i, q.i) && near(p.j, q.j); };
      comparison.missed += f >= other.size() || std::ranges::none_of(other[f], matches);
    }
  return comparison;
}

std::vector<MotionRow> measure_motions(const std::vector<MotionCase>& motions, const MotionResult& fine,
                                       double reference_step, std::size_t repetitions, std::size_t starts) {
  std::vector<MotionResult> results;
  for (const MotionCase& motion : motions) results.push_back(measure_motion(motion));
  time_motions(motions, results, repetitions);
  std::vector<MotionRow> rows;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const auto against_fine = compare_frames(fine.frame_contacts, results[k].frame_contacts);
    rows.push_back({motions[k], std::move(results[k]), reference_step, against_fine,
                    measure_starts(motions[k], starts)});
  }
  return rows;
}

}  // namespace catena::bench
