#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/progress.h"
#include "catena/core/error.h"
#include "catena/core/readers/chain_format.h"
#include "catena/properties/fuzz/failure_store.h"
#include "catena/properties/fuzz/fuzzer.h"
#include "catena/properties/variant_name.h"

namespace catena::properties {
namespace {

using Clock = std::chrono::steady_clock;

class FuzzCommand final : public Command {
 public:
  void configure(CLI::App& app) override {
    app.add_option("--variant", variants_, "Only this variant, parameters and mutants too; repeatable")
        ->type_name("V")
        ->allow_extra_args(false);
    auto* seconds = app.add_option("--seconds", seconds_, "Stop after so long (default 10)")
                        ->type_name("S")
                        ->check(CLI::NonNegativeNumber);
    app.add_option("--cases", cases_, "Stop after so many chains")->type_name("N")->excludes(seconds);
    app.add_option("--seed", seed_, "Start of the random numbers")->type_name("X")->capture_default_str();
    app.add_option("--scene-family", families_, "Only chains of this family; repeatable")
        ->type_name("F")
        ->allow_extra_args(false);
    app.add_option("--max-spheres", size_, "Most spheres a chain")
        ->type_name("N")
        ->check(CLI::Range(1u, 4000u))
        ->capture_default_str();
    app.add_option("--long-spheres", long_size_,
                   "Most spheres of one chain in 200; no more than --max-spheres: none is longer")
        ->type_name("N")
        ->check(CLI::Range(0u, 4000u))
        ->capture_default_str();
    app.add_option("--failures", failures_, "Folder that counterexamples are stored in")
        ->type_name("DIR")
        ->capture_default_str();
    app.add_option("--replay", replay_,
                   "Run this chain again on every variant, with every property; repeatable")
        ->type_name("FILE")
        ->allow_extra_args(false);
  }

  int run() override { return replay_.empty() ? fuzz() : replay(); }

 private:
  int fuzz() {
    Fuzzer::Options options{seed_, size_, long_size_, {}};
    for (const auto& name : families_) options.families.push_back(FamilyRegistry::instance().family(name));
    Fuzzer fuzzer(subjects(), std::move(options));
    const auto start = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    Progress progress(cases_ > 0 ? cases_ : static_cast<std::uint64_t>(10 * seconds_) + 1);
    std::uint64_t tenths = 0;
    while (cases_ > 0 ? fuzzer.cases() < cases_ : elapsed() < seconds_) {
      const auto counterexample = fuzzer.step();
      if (counterexample) {
        progress.clear();
        tell(*counterexample);
        return 1;
      }
      // The bar counts chains, or tenths of a second.
      if (cases_ > 0 || static_cast<std::uint64_t>(10 * elapsed()) >= tenths) {
        ++tenths;
        progress.step(fmt::format("{} chains, no finding", fuzzer.cases()));
      }
    }
    progress.clear();
    summarise(fuzzer, elapsed());
    return 0;
  }

  int replay() const {
    Suite suite(subjects());
    bool anything = false;
    for (const auto& file : replay_) {
      const Case test = Case::of(load_chain(file));
      const auto findings = suite.check_all(test);
      for (const Finding& f : findings) fmt::print("{}: {}: {}: {}\n", file, f.variant, f.property, f.what);
      if (findings.empty())
        fmt::print("{}: {} spheres, {} pairs: every property holds for {} variants\n", file,
                   test.chain.size(), test.exact.pair_count, suite.variants().size());
      anything |= !findings.empty();
    }
    return anything ? 1 : 0;
  }

  /// The variants asked for; else all that can run here, and those with blocks again in small.
  std::vector<Subject> subjects() const {
    std::vector<Subject> subjects;
    for (const auto& name : variants_) subjects.push_back(Subject::named(name));
    if (!subjects.empty()) return subjects;
    subjects = Subject::available();
    for (Subject& small : in_small_blocks(subjects))
      if (small.exact()) subjects.push_back(std::move(small));
    return subjects;
  }

  void tell(const Fuzzer::Counterexample& c) const {
    std::ostringstream chain;
    write_chain(chain, c.shrunk);
    const auto path = store(failures_, c, seed_);
    fmt::print("FOUND by case {} ({}, seed {}): {}\n  {}: {}\nshrunk from {} to {} spheres:\n\n{}\n",
               c.number, c.family, seed_, c.finding.variant, c.finding.property, c.finding.what,
               c.found.size(), c.shrunk.size(), chain.str());
    fmt::print("stored in {}\nrun it again: catena fuzz --replay {}{}\n", path.string(), path.string(),
               variants_.empty() ? "" : fmt::format(" --variant '{}'", c.finding.variant));
  }

  static void summarise(const Fuzzer& fuzzer, double seconds) {
    const auto& tally = fuzzer.suite().tally();
    fmt::print(
        "{} chains in {:.1f} s ({:.0f} a minute), {} checks on {} variants, {} refusals within declared "
        "limits: "
        "no finding\n\nchains drawn\n",
        fuzzer.cases(), seconds, 60 * static_cast<double>(fuzzer.cases()) / seconds, tally.checks,
        fuzzer.suite().variants().size(), tally.refusals);
    for (const auto& [family, cases] : fuzzer.by_family()) fmt::print("  {:<12}{:>10}\n", family, cases);
    fmt::print("  {:<12}{:>10}\n", "(long ones)", fuzzer.long_cases());
    fmt::print("\nreached\n");
    const Interest best = fuzzer.pool().best();
    for (std::size_t t = 0; t < Interest::targets; ++t)
      if (t == 2)
        fmt::print("  {:<16}{:>10}\n", Interest::names[t], fmt::format("2^-{:.0f}", best.score[t]));
      else
        fmt::print("  {:<16}{:>10.0f}\n", Interest::names[t], best.score[t]);
  }

  std::vector<std::string> variants_, families_, replay_;
  double seconds_ = 10;
  std::uint64_t cases_ = 0, seed_ = 1;
  std::uint32_t size_ = Fuzzer::Options{}.size, long_size_ = Fuzzer::Options{}.long_size;
  std::string failures_ = "catena-failures";
};

const RegisterCommand<FuzzCommand> registered{
    "fuzz", "Search for a chain on which a variant breaks a property, and shrink it"};

}  // namespace
}  // namespace catena::properties
