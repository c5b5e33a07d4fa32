#include "catena/core/plan/calibrate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/variant_name.h"

namespace catena {
namespace {

constexpr double seconds_each = 0.02;
/// A serial share from here on says that threads take nothing off what they share out.
constexpr double hardly_helped = 0.9;

/// A spring whose turns lie side by side: near itself, and without collisions.
Chain spring(std::uint32_t n) {
  constexpr double width = 10, pitch = 3;
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double turn = i / width;
    spheres.push_back({static_cast<float>(width * std::cos(turn)), static_cast<float>(width * std::sin(turn)),
                       static_cast<float>(pitch * turn / (2 * std::numbers::pi)), 1});
  }
  return Chain(std::move(spheres));
}

/// Least time of one build and find, of so many as fit into `seconds_each`.
double least_ms(Variant& variant, std::uint32_t n) {
  const Chain chain = spring(n);
  const std::uint32_t batch = std::max(1u, 2000 / n);  // so that the clock's own time is little of it
  Collisions found;
  double least = std::numeric_limits<double>::infinity();
  const Stopwatch all;
  do {
    const Stopwatch watch;
    for (std::uint32_t k = 0; k < batch; ++k) {
      variant.build(chain);
      variant.find(chain, {}, found);
    }
    least = std::min(least, watch.ms() / batch);
  } while (all.ms() < seconds_each * 1e3);
  return least;
}

/// That of each of two searches, by turns: what disturbs the machine for a while meets both.
struct LeastOfTwo {
  double first_ms = std::numeric_limits<double>::infinity(), second_ms = first_ms;

  LeastOfTwo(Variant& first, std::uint32_t first_n, Variant& second, std::uint32_t second_n) {
    constexpr int turns = 3;
    for (int turn = 0; turn < turns; ++turn) {
      first_ms = std::min(first_ms, least_ms(first, first_n));
      second_ms = std::min(second_ms, least_ms(second, second_n));
    }
  }
  double saved_ms() const { return first_ms - second_ms; }
};

double pairs(double n) { return n * (n - 1) / 2; }

MachineCost measured(const Machine::VariantCost& v) {
  const auto variant = StrategyRegistry::instance().make(v.variant);
  const std::uint32_t few = v.on_device ? 1024 : 16, many = v.on_device ? 1u << 18 : v.all_pairs ? 256 : 8192;
  const LeastOfTwo least(*variant, few, *variant, many);
  return cost_through(v, {few, least.first_ms * 1e3}, {many, least.second_ms * 1e3});
}

/// What threads take off and what having them costs: a line through what they save on a chain of a few ranges
/// of work and on a long one. (One of a single range wakes no other thread, and so does not tell.)
void measure_threads(const Machine::VariantCost& v, unsigned cores, MachineCost& cost) {
  constexpr std::uint32_t few = 1u << 13, many = 1u << 17;
  VariantName name = VariantName::parse(v.variant);
  name.stages.front().settings.push_back({"threads", std::to_string(cores)});
  const auto alone = StrategyRegistry::instance().make(v.variant);
  const auto team = StrategyRegistry::instance().make(name.text());
  const LeastOfTwo of_few(*alone, few, *team, few), of_many(*alone, many, *team, many);
  const double saved_ns = std::max(0.0, (of_many.saved_ms() - of_few.saved_ms()) * 1e6 / (many - few));
  cost.sphere_ns = of_many.first_ms * 1e6 / many;  // where threads pay, so that a share of it is right there
  cost.serial = std::clamp(1 - saved_ns / (cost.sphere_ns * (1 - 1.0 / cores)), 0.0, 0.999);
  // Less than a quarter of what is built in is noise: other threads have to wake.
  const double least_us = cost.team_us / 4;
  cost.team_us = std::max(least_us, saved_ns * few * 1e-3 - of_few.saved_ms() * 1e3);
}

/// Again where others kept the cores busy, for that is no property of the machine.
void measure_threads_in_peace(const Machine::VariantCost& v, unsigned cores, MachineCost& cost) {
  constexpr int most_tries = 3;
  const MachineCost of_one = cost;
  for (int tries = 0; tries < most_tries; ++tries) {
    MachineCost found = of_one;
    measure_threads(v, cores, found);
    if (tries == 0 || found.serial < cost.serial) cost = found;
    if (cost.serial < hardly_helped) break;
  }
}

/// By a first search, where this process has not made one.
void measure_start(Machine::VariantCost& v) {
  if (v.start_ms() == 0) return;
  const Stopwatch watch;
  if (v.unavailable && v.unavailable()) return;
  const auto variant = StrategyRegistry::instance().make(v.variant);
  const Chain chain = spring(1024);
  Collisions found;
  variant->build(chain);
  variant->find(chain, {}, found);
  v.cost.start_ms = watch.ms();
}

}  // namespace

MachineCost cost_through(const Machine::VariantCost& v, SearchTook few, SearchTook many) {
  const auto items = [&](std::uint32_t n) { return v.all_pairs ? pairs(n) : n; };
  const double item_us = std::max(0.0, many.us - few.us) / (items(many.n) - items(few.n));
  MachineCost cost = v.cost;
  cost.fixed_us = std::max(0.0, few.us - item_us * items(few.n));
  (v.all_pairs ? cost.sphere_pair_ns : cost.sphere_ns) = item_us * 1e3;
  return cost;
}

Machine calibrate() {
  Machine machine = Machine::built_in();
  for (Machine::VariantCost& v : machine.costs)
    if (v.on_device) measure_start(v);
  std::erase_if(machine.costs,
                [](const Machine::VariantCost& v) { return v.unavailable && v.unavailable(); });
  for (Machine::VariantCost& v : machine.costs) try {
      v.cost = measured(v);
      if (v.cost.serial < 1 && machine.cores > 1) measure_threads_in_peace(v, machine.cores, v.cost);
    } catch (const CapacityError&) {
    }
  machine.source = "measured now";
  return machine;
}

std::vector<std::string> hardly_helped_by_threads(const Machine& machine) {
  std::vector<std::string> names;
  for (const Machine::VariantCost& v : machine.costs)
    if (machine.cores > 1 && v.cost.serial >= hardly_helped && v.cost.serial < 1) names.push_back(v.variant);
  return names;
}

std::uint32_t crossover(const Machine& machine) {
  const auto least = [&](bool all_pairs, std::uint32_t n) {
    double ms = std::numeric_limits<double>::infinity();
    for (const Machine::VariantCost& v : machine.costs)
      if (!v.on_device && v.all_pairs == all_pairs) ms = std::min(ms, v.cost.ms(n));
    return ms;
  };
  if (!std::isfinite(least(true, 1)) || !std::isfinite(least(false, 1))) return 0;
  std::uint32_t low = 0, high = 1u << 20;  // all pairs are cheaper at low, a tree at high
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (least(false, middle) < least(true, middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace catena
