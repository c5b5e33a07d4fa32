#include "catena/properties/fuzz/fuzzer.h"

#include <algorithm>

#include "catena/properties/fuzz/sequence.h"
#include "catena/properties/generators/mutate.h"
#include "catena/properties/generators/simplifications.h"
#include "catena/properties/giants.h"
#include "catena/reference/all_pairs.h"

namespace catena::properties {
namespace {

/// One case in three starts from the pool, and one of four others is measured for it: measuring costs as much
/// as a variant.
constexpr std::uint32_t mutated_one_in = 3, measured_one_in = 4;
/// And one case in so many is long: ids of 8 bits, totals of 16, a last block that is not full and stacks of
/// 128 slots need more than `size` spheres to go wrong. Long chains are neither mutated nor measured.
constexpr std::uint32_t long_one_in = 200;
/// Most errors show before that, on chains that shrink in no time.
constexpr std::uint64_t giants_after = 100;
constexpr const char* giant_family = "giants";
/// Chains that are kept for an error that depends on those before it.
constexpr std::size_t history = 32;

}  // namespace

Fuzzer::Fuzzer(std::vector<Subject> subjects, Options options)
    : options_(std::move(options)),
      suite_(std::move(subjects)),
      tree_(StrategyRegistry::instance().make("aCPU2+CPU2")),
      meter_(*tree_) {
  if (options_.families.empty()) options_.families = FamilyRegistry::instance().families();
}

void Fuzzer::watch(Watch each_chain, Suite::Watch each_check) {
  watch_ = std::move(each_chain);
  watch_check_ = each_check;
  suite_.watch(std::move(each_check));
}

void Fuzzer::begin(const std::string& family, std::uint64_t number, const Chain& chain) const {
  if (watch_) watch_(family, number, chain);
}

std::optional<Fuzzer::Counterexample> Fuzzer::step() {
  if (cases_ == giants_after)
    if (auto found = giants_once()) return found;
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
  begin(origin, number, chain);

  auto exact = reference::all_pairs(chain);
  const double margin = exact.tightest.margin;
  const Case test(std::move(chain), std::move(exact.answer));
  if (auto finding = suite_.check_some(test, number))
    return counterexample(std::move(*finding), origin, number, test.chain);
  if (mutated || (!is_long && dice.one_in(measured_one_in))) pool_.offer(test.chain, meter_.of(test, margin));
  before_.push_back(test.chain);
  if (before_.size() > history) before_.pop_front();
  return std::nullopt;
}

std::optional<Fuzzer::Counterexample> Fuzzer::giants_once() {
  if (had_giants_) return std::nullopt;
  had_giants_ = true;
  for (const Case& giant : giants()) {
    begin(giant_family, cases_, giant.chain);
    if (auto finding = suite_.check_always(giant))
      return counterexample(std::move(*finding), giant_family, cases_, giant.chain);
  }
  return std::nullopt;
}

Fuzzer::Counterexample Fuzzer::counterexample(Finding finding, std::string family, std::uint64_t number,
                                              Chain chain) const {
  Counterexample c{std::move(finding), std::move(family), number, chain, {chain}};
  if (!options_.shrink || c.family == giant_family)
    return c;  // of those nothing can be left out that matters
  const std::uint32_t tries = 1'000'000 / std::max(50u, chain.size());  // a minute at most, for long ones too
  const auto fails = [&](const Chain& shorter) {
    begin(c.family, number, shorter);  // a simpler chain may crash
    return suite_.repeats(c.finding, shorter);
  };
  if (fails(chain)) {
    c.shrunk = {shrink(std::move(chain), fails, tries)};
    return c;
  }
  std::vector<Chain> chains(before_.begin(), before_.end());
  chains.push_back(std::move(chain));
  auto sequence = shortest_sequence(suite_.subject(c.finding.variant), c.finding.property, std::move(chains),
                                    watch_check_);
  c.repeats = sequence.has_value();
  if (sequence) c.shrunk = std::move(*sequence);
  return c;
}

}  // namespace catena::properties
