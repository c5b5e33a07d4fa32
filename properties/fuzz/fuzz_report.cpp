#include "catena/properties/fuzz/fuzz_report.h"

#include <fmt/format.h>

#include "catena/core/counted.h"
#include "catena/core/shell_word.h"
#include "catena/properties/fuzz/failure_store.h"

namespace catena::properties {
namespace {

constexpr std::uint32_t longest_printed = 200;  ///< spheres

std::string how_it_shrank(const Fuzzer::Counterexample& c) {
  if (!c.repeats)
    return fmt::format(
        "no new object of it fails so, not after the chains before this one either: chance, or a longer "
        "history\n"
        "the chain it was found on, of {}",
        counted(c.found.size(), "sphere"));
  if (c.shrunk.size() == 1 && c.shrunk.front().size() == c.found.size())
    return "of " + counted(c.found.size(), "sphere");
  if (c.shrunk.size() == 1)
    return fmt::format("shrunk from {} to {}", c.found.size(), counted(c.shrunk.front().size(), "sphere"));
  return fmt::format("it depends on history: a new object fails after these {} chains, in this order",
                     c.shrunk.size());
}

std::string printed(const Chain& chain) {
  return chain.size() > longest_printed ? fmt::format("({} spheres: see its file)\n", chain.size())
                                        : chain_file_of(chain);
}

}  // namespace

void tell_chains(const std::vector<Chain>& chains) {
  for (const Chain& chain : chains) fmt::print("{}\n", printed(chain));
}

void tell_stored(const std::vector<std::filesystem::path>& stored, const std::string& variant) {
  std::string files, replay;
  for (const std::filesystem::path& file : stored) {
    files += fmt::format("{}{}", files.empty() ? "" : ", ", file.string());
    replay += " --replay " + shell_word(file.string());
  }
  fmt::print("stored in {}\nrun it again: catena fuzz{}{}\n", files, replay,
             variant.empty() ? "" : " --variant " + shell_word(variant));
}

void tell(const Fuzzer::Counterexample& c, std::uint64_t seed) {
  fmt::print("FOUND by case {} ({}, seed {}): {}\n  {}: {}\n{}:\n\n", c.number, c.family, seed,
             c.finding.variant, c.finding.property, c.finding.what, how_it_shrank(c));
  tell_chains(c.shrunk);
}

void summarise(const Fuzzer& fuzzer, double seconds, bool interrupted) {
  const auto& tally = fuzzer.suite().tally();
  fmt::print(
      "{}{} in {:.1f} s ({:.0f} a minute), {} on {}, {} within declared limits: no finding\n\nchains drawn\n",
      interrupted ? "interrupted: " : "", counted(fuzzer.cases(), "chain"), seconds,
      60 * static_cast<double>(fuzzer.cases()) / seconds, counted(tally.checks, "check"),
      counted(fuzzer.suite().variants().size(), "variant"), counted(tally.refusals, "refusal"));
  for (const auto& [family, cases] : fuzzer.by_family()) fmt::print("  {:<12}{:>10}\n", family, cases);
  fmt::print("  {:<12}{:>10}\n", "(long ones)", fuzzer.long_cases());
  fmt::print("\nreached\n");
  const Interest best = fuzzer.pool().best();
  for (std::size_t t = 0; t < Interest::targets; ++t)
    if (t == 2)
      fmt::print("  {:<16}{:>10}\n", Interest::names[t],
                 best.score[t] > 0 ? fmt::format("2^-{:.0f}", best.score[t]) : "none");  // of 0 < margin < 1
    else
      fmt::print("  {:<16}{:>10.0f}\n", Interest::names[t], best.score[t]);
}

}  // namespace catena::properties
