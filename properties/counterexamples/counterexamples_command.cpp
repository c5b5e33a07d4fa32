#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/output_file.h"
#include "catena/properties/counterexamples/search.h"
#include "catena/properties/fuzz/failure_store.h"

namespace catena::properties {
namespace {

/// `catena counterexamples`: the smallest chains on which the paper's own arithmetic fails, one for each way
/// to fail.
class CounterexamplesCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("--arithmetic", arithmetics_, "literal or double; repeatable (default: both)")
        .allow_extra_args(false)
        .one_of({"literal", "double"});
    app.add_option("--cases", cases_, "Chains drawn for each arithmetic")
        .type_name("N")
        .capture_default_str()
        .range(std::uint64_t{1}, std::uint64_t{1'000'000'000});
    app.add_option("--seed", seed_, "Start of the random numbers")
        .type_name("X")
        .whole_number()
        .capture_default_str();
    app.add_option("--out", out_, "Folder to store them in as .chain files; none: they are printed only")
        .type_name("DIR");
    const auto replay =
        app.add_option("--replay", replay_, "Say how each arithmetic fails on this file instead; repeatable")
            .type_name("FILE")
            .allow_extra_args(false);
    app.exclude_others(replay, {"--arithmetic"});
  }

  int run() override {
    if (!out_.empty()) require_folder(out_);
    if (arithmetics_.empty()) arithmetics_ = {"literal", "double"};
    for (const auto& arithmetic : arithmetics_) replay_.empty() ? search(arithmetic) : replay(arithmetic);
    return 0;
  }

 private:
  void search(const std::string& arithmetic) const {
    const auto found = smallest_counterexamples(arithmetic, cases_, seed_);
    for (const Failure& failure : failures()) {
      const auto its = std::ranges::find(found, &failure, &Counterexample::failure);
      if (its == found.end()) {
        fmt::print("{} {}: never, in {} chains\n\n", arithmetic, failure.name, cases_);
        continue;
      }
      fmt::print("{} {}: in {} of {} chains; the smallest:\n{}\n", arithmetic, failure.name, its->witnesses,
                 cases_, text_of(*its));
      if (!out_.empty()) store(*its);
    }
  }

  void store(const Counterexample& counterexample) const {
    std::error_code failed;
    std::filesystem::create_directories(out_, failed);
    const auto path = std::filesystem::path(out_) / file_name_of(counterexample);
    write_file(path, text_of(counterexample));
  }

  void replay(const std::string& arithmetic) const {
    Observer observer(arithmetic);
    for (const auto& file : replay_) {
      const Observed seen = observer.of(load_chain(file));
      bool any = false;
      for (const Failure& failure : failures())
        if (const auto where = failure.on(seen)) {
          fmt::print("{}: {} {}: {}\n", file, arithmetic, failure.name, *where);
          any = true;
        }
      if (!any) fmt::print("{}: {}: no failure\n", file, arithmetic);
    }
  }

  std::vector<std::string> arithmetics_, replay_;
  std::uint64_t cases_ = 300'000, seed_ = 1;
  std::string out_;
};

const RegisterCommand<CounterexamplesCommand> registered{
    "counterexamples",
    "The smallest chains on which the paper's own arithmetic fails, one for each way to fail"};

}  // namespace
}  // namespace catena::properties
