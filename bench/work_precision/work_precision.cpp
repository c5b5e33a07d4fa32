#include "catena/bench/work_precision/work_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "catena/bench/stability/cell.h"
#include "catena/bench/timing/sampling.h"
#include "catena/bench/tube/contacts.h"
#include "catena/bench/tube/error.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

constexpr std::uint32_t most_all_pairs = 5000;

struct Runner {
  std::unique_ptr<Variant> variant;
  Point point;
};

double answer_error(const Cell& cell) {
  const auto& c = cell.found.comparison;
  const double wrong = cell.found.by_pairs ? static_cast<double>(c.missing + c.invented)
                                           : static_cast<double>(c.wrong_counts) / 2;
  return wrong / static_cast<double>(std::max<std::uint64_t>(1, cell.exact_pairs));
}

/// How deep the deepest pair lies that is in one list and not in the other, or how far apart; in units of
/// length.
double deepest_difference(const Chain& chain, const std::vector<Pair>& exact, std::vector<Pair> found) {
  std::ranges::sort(found);
  std::vector<Pair> wrong;
  std::ranges::set_symmetric_difference(exact, found, std::back_inserter(wrong));
  double deepest = 0;
  for (const Pair& pair : wrong) {
    const Sphere &a = chain[pair.i], &b = chain[pair.j];
    const double distance = std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
    deepest = std::max(deepest, std::abs(distance - (double{a.radius} + b.radius)));
  }
  return deepest;
}

/// What the variant made of the chain, as errors; `cell` is of the same chain.
void add_errors(Point& point, const Tube& tube, const Cell& cell, Variant& variant, const Chain& chain,
                const reference::Answer& exact) {
  const auto& wrong = cell.found.comparison;
  point.answer_error = answer_error(cell);
  point.exact_pairs = cell.exact_pairs;
  point.missing = wrong.missing;
  point.invented = wrong.invented;
  point.worst_margin = wrong.worst_margin;
  if (wrong.missing + wrong.invented == 0) return;
  Collisions found;
  variant.build(chain);
  variant.find(chain, {}, found);
  point.depth_error = deepest_difference(chain, exact.pairs, std::move(found.pairs)) / tube.radius;
}

void time_interleaved(std::vector<Runner>& runners, const Chain& chain, std::size_t repetitions) {
  Collisions found;
  std::vector<std::function<double()>> runs;
  for (const Runner& runner : runners)
    runs.emplace_back([&, variant = runner.variant.get()] {
      const Stopwatch watch;
      variant->build(chain);
      variant->find(chain, {}, found);
      return watch.ms();
    });
  auto ms = interleave(runs, repetitions, std::numeric_limits<double>::infinity(), chain.size());
  for (std::size_t k = 0; k < runners.size(); ++k) runners[k].point.time = Spread::of(std::move(ms[k]));
}

}  // namespace

WorkPrecision work_precision(const Tube& tube, const std::vector<std::uint32_t>& sizes,
                             const std::vector<std::string>& variants, std::size_t repetitions, double offset,
                             const std::vector<double>& tolerances) {
  WorkPrecision result;
  const auto all = approaches(tube);
  const auto leave_out = [&](const std::string& name, const std::string& why) {
    const auto of_it = [&](const std::string& line) { return line.starts_with(name + ": "); };
    if (std::ranges::none_of(result.left_out, of_it))
      result.left_out.push_back(fmt::format("{}: {}", name, why));
  };
  std::vector<std::pair<std::uint32_t, std::optional<double>>> chains;
  for (const std::uint32_t n : sizes) chains.emplace_back(n, std::nullopt);
  for (const double tolerance : tolerances) chains.emplace_back(spheres_for(tube, tolerance), tolerance);
  for (const auto& [n, tolerance] : chains) {
    const Chain chain = inscribed_chain(tube, n, offset);
    const auto exact = reference::find(chain);
    const double gap = tube_error(tube, all, n).gap / tube.radius;
    const double stored = stored_error(tube, n, offset) / tube.radius;
    std::vector<Runner> runners;
    for (const auto& name : variants) {
      const VariantInfo info = StrategyRegistry::instance().describe(name);
      if (n > most_all_pairs && info.all_pairs) {
        leave_out(name, fmt::format("O(n^2), left out above {} spheres", most_all_pairs));
        continue;
      }
      try {
        auto variant = StrategyRegistry::instance().make(name);
        const Cell cell = measure(tube.name, info, *variant, chain, exact);
        if (cell.outcome == Outcome::refused || cell.outcome == Outcome::undecided) {
          leave_out(name, cell.found.reason);
          continue;
        }
        if (cell.defect)
          throw InputError(
              fmt::format("{} is wrong on {} with {} spheres: {}", name, tube.name, n, cell.found.reason));
        Point point{.tube = tube.name,
                    .variant = name,
                    .arithmetic = cell.arithmetic,
                    .n = n,
                    .tube_error = gap,
                    .stored_error = stored,
                    .repetitions = repetitions,
                    .tolerance = tolerance,
                    .offset = offset};
        add_errors(point, tube, cell, *variant, chain, exact);
        runners.push_back({std::move(variant), std::move(point)});
      } catch (const CapacityError& why) {
        leave_out(name, why.what());
      }
    }
    time_interleaved(runners, chain, repetitions);
    for (Runner& runner : runners) result.points.push_back(std::move(runner.point));
  }
  mark_dominated(result.points);
  return result;
}

}  // namespace catena::bench
