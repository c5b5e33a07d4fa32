#include "catena/properties/fuzz/fuzzer.h"

#include <algorithm>

#include "catena/properties/generators/mutate.h"
#include "catena/properties/generators/simplifications.h"
#include "catena/reference/all_pairs.h"

namespace catena::properties {
namespace {

/// One case in three starts from the pool, and one of four others is measured for it: measuring costs as much
/// as a variant.
constexpr std::uint32_t mutated_one_in = 3, measured_one_in = 4;
/// And one case in so many is long: ids of 8 bits, totals of 16, a last block that is not full and stacks of
/// 128 slots need more than `size` spheres to go wrong. Long chains are neither mutated nor measured.
constexpr std::uint32_t long_one_in = 200;

}  // namespace

Fuzzer::Fuzzer(std::vector<Subject> subjects, Options options)
    : options_(std::move(options)),
      suite_(std::move(subjects)),
      tree_(StrategyRegistry::instance().make("aCPU2+CPU2")),
      meter_(*tree_) {
  if (options_.families.empty()) options_.families = FamilyRegistry::instance().families();
}

std::optional<Fuzzer::Counterexample> Fuzzer::step() {
  const std::uint64_t number = cases_++;
  Dice dice(options_.seed * 0x9E3779B97F4A7C15u + number);
  const bool is_long = options_.long_size > options_.size && dice.one_in(long_one_in);
  const bool mutated = !is_long && !pool_.empty() && dice.one_in(mutated_one_in);
  const Family& family = options_.families[dice.below(static_cast<std::uint32_t>(options_.families.size()))];
  Chain chain = mutated ? mutate(pool_.pick(dice), dice, options_.size)
                        : generate(family, dice, is_long ? options_.long_size : options_.size);
  const std::string origin = mutated ? "mutated" : family.name;
  long_cases_ += chain.size() > options_.size;
  ++by_family_[origin];

  auto exact = reference::all_pairs(chain);
  const double margin = exact.tightest.margin;
  const Case test(std::move(chain), std::move(exact.answer));
  if (auto finding = suite_.check_some(test, number))
    return counterexample(std::move(*finding), origin, test.chain);
  if (mutated || (!is_long && dice.one_in(measured_one_in))) pool_.offer(test.chain, meter_.of(test, margin));
  return std::nullopt;
}

Fuzzer::Counterexample Fuzzer::counterexample(Finding finding, std::string family, Chain chain) const {
  const std::uint32_t tries = 1'000'000 / std::max(50u, chain.size());  // a minute at most, for long ones too
  const auto fails = [&](const Chain& c) { return suite_.repeats(finding, c); };
  Chain shrunk = options_.shrink ? shrink(chain, fails, tries) : chain;
  return {std::move(finding), std::move(family), cases_ - 1, std::move(chain), std::move(shrunk)};
}

}  // namespace catena::properties
