#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/progress.h"
#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/notice.h"
#include "catena/properties/fuzz/failure_store.h"
#include "catena/properties/fuzz/fault.h"
#include "catena/properties/fuzz/fuzz_report.h"
#include "catena/properties/fuzz/fuzzer.h"
#include "catena/properties/fuzz/watched.h"
#include "catena/properties/variant_name.h"

namespace catena::properties {
namespace {

using Clock = std::chrono::steady_clock;

class FuzzCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("--variant", variants_, "Only this variant, parameters and mutants too; repeatable")
        .type_name("V")
        .allow_extra_args(false);
    const auto seconds = app.add_option("--seconds", seconds_, "Stop after so long (default 10)")
                             .type_name("S")
                             .range(1e-3, 1e9);
    app.add_option("--cases", cases_, "Stop after so many chains")
        .type_name("N")
        .whole_number(1)
        .excludes(seconds);
    app.add_option("--seed", seed_, "Start of the random numbers")
        .type_name("X")
        .whole_number()
        .capture_default_str();
    app.add_option("--scene-family", families_, "Only chains of this family; repeatable")
        .type_name("F")
        .allow_extra_args(false);
    app.add_option("--max-spheres", size_, "Most spheres a chain")
        .type_name("N")
        .range(1u, 4000u)
        .capture_default_str();
    app.add_option("--long-spheres", long_size_,
                   "Most spheres of one chain in 200; no more than --max-spheres: none is longer")
        .type_name("N")
        .range(0u, 4000u)
        .capture_default_str();
    app.add_option(
           "--timeout", timeout_,
           "A variant that works on one chain for longer hangs, which is a finding; 0: it may take for ever")
        .type_name("S")
        .range(0.0, 1e9)
        .capture_default_str();
    app.add_option("--failures", failures_, "Folder that counterexamples are stored in")
        .type_name("DIR")
        .capture_default_str();
    const auto replay =
        app.add_option("--replay", replay_,
                       "Run this chain again on every variant, with every property; repeatable")
            .type_name("FILE")
            .allow_extra_args(false);
    app.exclude_others(replay, {"--variant", "--timeout"});
  }

  /// The search is a process of its own, so that a variant that crashes or hangs leaves its chain.
  int run() override {
    if (replay_.empty()) require_folder(failures_);
    Notebook notebook;
    bool mine = false;
    const Ending ending = watched(
        notebook, timeout_, [&] { return replay_.empty() ? fuzz(notebook) : replay(notebook); }, mine);
    if (mine || ending.fault.empty()) return ending.code;
    if (notebook.variant().empty())
      throw Error(fmt::format("the search {} before its first check; leave out variants until it does not",
                              ending.fault));
    if (replay_.empty()) return tell_fault(notebook, ending);
    fmt::print("{}: {}: {}: {}\n", notebook.chain_file(), notebook.variant(), notebook.property(),
               ending.fault);
    return 1;
  }

 private:
  int fuzz(Notebook& notebook) {
    Fuzzer::Options options{seed_, size_, long_size_, {}};
    for (const auto& name : families_) options.families.push_back(FamilyRegistry::instance().family(name));
    Fuzzer fuzzer(subjects(), std::move(options));
    fuzzer.watch(
        [&](const std::string& family, std::uint64_t number, const Chain& chain) {
          notebook.begin(origin_of(family, seed_, number) + '\n' + chain_file_of(chain));
        },
        beats(notebook));
    const auto start = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    Progress progress(cases_ > 0 ? cases_ : static_cast<std::uint64_t>(10 * seconds_) + 1);
    std::uint64_t tenths = 0;
    const auto finding = [&](const std::optional<Fuzzer::Counterexample>& counterexample) {
      if (!counterexample) return false;
      progress.clear();
      tell(*counterexample, seed_);
      or_said([&] {
        tell_stored(store(failures_, *counterexample, seed_),
                    variants_.empty() ? "" : counterexample->finding.variant);
      });
      return true;
    };
    while (!interrupted() && (cases_ > 0 ? fuzzer.cases() < cases_ : elapsed() < seconds_)) {
      if (finding(fuzzer.step())) return 1;
      // The bar counts chains, or tenths of a second.
      if (cases_ > 0 || static_cast<std::uint64_t>(10 * elapsed()) >= tenths) {
        ++tenths;
        progress.step(fmt::format("{} chains, no finding", fuzzer.cases()));
      }
    }
    if (!interrupted() && finding(fuzzer.giants_once())) return 1;
    progress.clear();
    summarise(fuzzer, elapsed(), interrupted());
    return 0;
  }

  int replay(Notebook& notebook) const {
    Suite suite(subjects());
    suite.watch(beats(notebook));
    bool anything = false;
    for (const auto& file : replay_) {
      notebook.begin(file);
      const Case test = Case::of(load_chain(file));
      const auto findings = suite.check_all(test);
      for (const Finding& f : findings) fmt::print("{}: {}: {}: {}\n", file, f.variant, f.property, f.what);
      if (findings.empty())
        fmt::print("{}: {}, {}: every property holds for {}\n", file, counted(test.chain.size(), "sphere"),
                   counted(test.exact.pair_count, "pair"), counted(suite.variants().size(), "variant"));
      anything |= !findings.empty();
    }
    return anything ? 1 : 0;
  }

  /// The variants asked for; else all that can run here, and those with blocks again in small.
  std::vector<Subject> subjects() const {
    std::vector<Subject> subjects;
    for (const auto& name : variants_) {
      Subject subject = Subject::named(name);
      const auto same = [&](const Subject& other) { return other.info.name == subject.info.name; };
      if (std::ranges::none_of(subjects, same)) subjects.push_back(std::move(subject));
    }
    if (!subjects.empty()) return subjects;
    subjects = Subject::available();
    for (Subject& small : in_small_blocks(subjects))
      if (small.exact()) subjects.push_back(std::move(small));
    return subjects;
  }

  static Suite::Watch beats(Notebook& notebook) {
    return [&notebook](const Subject& subject, const Property& property) {
      notebook.check(subject.info.name, property.name());
    };
  }

  /// What was found is a finding, stored or not.
  template <class Store>
  static void or_said(const Store& store) {
    std::fflush(stdout);
    try {
      store();
    } catch (const InputError& why) {
      notice("catena", why.what());
    }
  }

  /// Of a crash or a hang there is what the notebook says. It is stored before it is shrunk.
  int tell_fault(const Notebook& notebook, const Ending& ending) const {
    const Finding finding{notebook.variant(), notebook.property(), ending.fault};
    const std::string text = notebook.chain_file(), origin = text.substr(0, text.find('\n'));
    fmt::print("FOUND ({}): {}\n  {}: {}\n", origin, finding.variant, finding.property, finding.what);
    std::filesystem::path found;
    or_said([&] {
      found = store(failures_, finding, origin, text.substr(origin.size() + 1));
      fmt::print("stored in {}\n", found.string());
      std::fflush(stdout);
      shrink(notebook, ending, finding, origin, found);
    });
    if (found.empty()) fmt::print("\n{}", text.substr(origin.size() + 1));
    return 1;
  }

  void shrink(const Notebook& notebook, const Ending& ending, const Finding& finding,
              const std::string& origin, const std::filesystem::path& found) const {
    const auto fault = shrink_fault(finding, load_chain(found), before(notebook, finding), timeout_,
                                    ending.hung ? 5 * timeout_ : 20);
    if (!fault.repeats)
      fmt::print(
          "no new object does so, not after the chains before this one either: chance, or a longer "
          "history\n\n");
    else if (fault.chains.size() == 1)
      fmt::print("shrunk to {}:\n\n", counted(fault.chains.front().size(), "sphere"));
    else
      fmt::print("it depends on history: a new object does so after these {} chains, in this order:\n\n",
                 fault.chains.size());
    tell_chains(fault.chains);
    const auto shrunk = store(failures_, finding, origin + ", shrunk", fault.chains);
    if (std::ranges::find(shrunk, found) == shrunk.end()) std::filesystem::remove(found);
    tell_stored(shrunk, finding.variant);
  }

  /// The chains that were begun before the last one.
  std::vector<Chain> before(const Notebook& notebook, const Finding& finding) const {
    std::vector<Chain> chains;
    for (const std::string& text : notebook.before()) {
      const auto file = store(failures_, finding, "before", text.substr(text.find('\n') + 1), "-before");
      chains.push_back(load_chain(file));  // chains are read from files alone
      std::filesystem::remove(file);
    }
    return chains;
  }

  std::vector<std::string> variants_, families_, replay_;
  double seconds_ = 10, timeout_ = 60;
  std::uint64_t cases_ = 0, seed_ = 1;
  std::uint32_t size_ = Fuzzer::Options{}.size, long_size_ = Fuzzer::Options{}.long_size;
  std::string failures_ = "catena-failures";
};

const RegisterCommand<FuzzCommand> registered{
    "fuzz", "Search for a chain on which a variant breaks a property, and shrink it"};

}  // namespace
}  // namespace catena::properties
