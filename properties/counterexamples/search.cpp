#include "catena/properties/counterexamples/search.h"

#include <fmt/format.h>

#include <new>
#include <sstream>
#include <stdexcept>

#include "catena/core/readers/chain_format.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/generators/simplifications.h"
#include "catena/properties/property.h"
#include "catena/reference/verify.h"

namespace catena::properties {
namespace {

constexpr std::uint64_t shrunk_of_each = 24;  ///< witnesses that are shrunk, for each way to fail

void expect_robust_exact(const Counterexample& c) {
  const auto variant = StrategyRegistry::instance().make("aCPU2+CPU2");
  const Case test = Case::of(c.chain);
  const auto found = reference::verify(*variant, false, test.chain, test.exact);
  if (found.verdict == reference::Verdict::undecided) throw std::bad_alloc();
  if (found.verdict != reference::Verdict::exact)
    throw std::logic_error(fmt::format("robust arithmetic fails on the counterexample of {}: {}",
                                       c.failure->name, found.reason));
}

}  // namespace

std::vector<Counterexample> smallest_counterexamples(const std::string& arithmetic, std::uint64_t cases,
                                                     std::uint64_t seed, std::uint32_t size) {
  Observer observer(arithmetic);
  const auto families = FamilyRegistry::instance().families();
  std::vector<std::optional<Counterexample>> best(failures().size());
  for (std::uint64_t number = 0; number < cases; ++number) {
    Dice dice(seed * 0x9E3779B97F4A7C15u + number);
    const Family& family = families[dice.below(static_cast<std::uint32_t>(families.size()))];
    const Observed seen = observer.of(generate(family, dice, size));
    for (std::size_t k = 0; k < best.size(); ++k) {
      const Failure& failure = failures()[k];
      if (!failure.on(seen)) continue;
      if (best[k] && ++best[k]->witnesses > shrunk_of_each) continue;
      Chain shrunk =
          shrink(seen.chain, [&](const Chain& c) { return failure.on(observer.of(c)).has_value(); });
      if (!best[k]) best[k] = {arithmetic, &failure, shrunk, "", 1};
      if (simpler(shrunk, best[k]->chain)) best[k]->chain = std::move(shrunk);
    }
  }
  std::vector<Counterexample> found;
  for (auto& counterexample : best) {
    if (!counterexample) continue;
    expect_robust_exact(*counterexample);
    counterexample->where = *counterexample->failure->on(observer.of(counterexample->chain));
    found.push_back(std::move(*counterexample));
  }
  return found;
}

std::string text_of(const Counterexample& c) {
  std::ostringstream chain;
  write_chain(chain, c.chain);
  return fmt::format(
      "# {}, {}: {}.\n# Here {}.\n# Robust arithmetic is exact on it. No simplification of it fails like "
      "this.\n"
      "# Made by catena counterexamples --arithmetic {}\n{}",
      c.arithmetic, c.failure->name, c.failure->what, c.where, c.arithmetic, chain.str());
}

std::string file_name_of(const Counterexample& c) {
  return fmt::format("{}-{}.chain", c.arithmetic, c.failure->name);
}

}  // namespace catena::properties
