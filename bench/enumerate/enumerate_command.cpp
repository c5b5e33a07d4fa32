#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/enumerate/judge.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"

namespace catena::bench {
namespace {

/// `catena enumerate`: counts lattice walks by a variant, against what others published.
class EnumerateCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("--walks", steps_, "Steps of the longest walks; all shorter ones are counted on the way")
        .type_name("N")
        .range(1, Walk::most_steps)
        .capture_default_str();
    std::vector<std::string> lattices{"cubic", "square"};
    for (const OtherLattice& lattice : other_lattices()) lattices.push_back(lattice.name);
    app.add_option("--lattice", lattice_,
                   "Of the walks; on other than cubic and square their points alone count")
        .one_of(lattices)
        .capture_default_str();
    app.add_option(
           "--radius", radius_,
           "Of every sphere, in steps (default: just below 1/2, where walks may not meet themselves, "
           "and, on cubic and square, 1/2, where they may not touch themselves); below 1/2 on honeycomb")
        .type_name("R")
        .range(0.0, 100.0);
    app.add_option("--variant", variant_, "Who says which walks collide; see catena list")
        .capture_default_str();
    app.add_flag("--json", json_, "One JSON object a line for each number");
    app.footer(
        "The tables are in bench/enumerate/published.cpp and other_lattice.cpp. Exit code 1 when a number "
        "differs.");
  }

  int run() override {
    const auto variant = blaming(variant_, [&] { return StrategyRegistry::instance().make(variant_); });
    bool differs = false;
    for (const WalkQuestion& question : questions()) {
      const auto verdicts = blaming(variant_, [&] { return judge_walks(*variant, question); });
      for (const WalkVerdict& v : verdicts) differs |= v.differs();
      if (json_)
        for (const WalkVerdict& v : verdicts) fmt::print("{}\n", json_line(to_json(v)));
      else
        print(question, verdicts);
    }
    return differs ? 1 : 0;
  }

 private:
  std::vector<WalkQuestion> questions() const {
    const float below = std::nextafter(0.5f, 0.0f);
    if (const OtherLattice* other = other_lattice(lattice_)) {
      const float radius = radius_ ? static_cast<float>(*radius_) : below;
      return {{.radius = radius, .steps = steps_, .other = other}};
    }
    const int dimensions = lattice_ == "square" ? 2 : 3;
    if (radius_) return {{dimensions, static_cast<float>(*radius_), false, steps_}};
    return {{dimensions, below, true, steps_}, {dimensions, 0.5f, false, steps_}};
  }

  void print(const WalkQuestion& question, const std::vector<WalkVerdict>& verdicts) const {
    std::string counts;
    for (const WalkVerdict& v : verdicts) {
      if (v.counts != counts) {
        counts = v.counts;
        const PublishedTable* table = table_of(v);
        fmt::print("{} lattice, radius {:.9g}, {}: {}{}\n", lattice_name(question), question.radius, variant_,
                   counts, table ? fmt::format(" ({})", table->address()) : "; no table to compare with");
        if (table && !table->erratum.empty()) fmt::print("  {}\n", table->erratum);
        fmt::print("  {:>5} {:>20} {:>20}\n", "steps", "found", "published");
      }
      fmt::print("  {:>5} {:>20} {:>20}{}\n", v.steps, v.found,
                 v.published ? fmt::format("{}", *v.published) : "-", v.differs() ? "  DIFFERS" : "");
    }
    fmt::print("  {:.1f} s\n", verdicts.front().ms / 1000);
  }

  static const PublishedTable* table_of(const WalkVerdict& verdict) {
    for (const PublishedTable& table : published_tables())
      if (table.sequence == verdict.sequence) return &table;
    for (const OtherLattice& lattice : other_lattices())
      if (lattice.table.sequence == verdict.sequence) return &lattice.table;
    return nullptr;
  }

  int steps_ = 8;
  std::string lattice_ = "cubic", variant_ = "Hybrid";
  std::optional<double> radius_;
  bool json_ = false;
};

const RegisterCommand<EnumerateCommand> registered{
    "enumerate", "Count lattice walks by a variant, against published tables"};

}  // namespace
}  // namespace catena::bench
