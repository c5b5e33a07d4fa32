#include <algorithm>
#include <functional>
#include <memory>

#include "catena/bench/timing/median_interval.h"
#include "catena/bench/timing/sampling.h"
#include "catena/core/strategy/timings.h"
#include "catena/reports/host_variants.h"

namespace catena::reports {
namespace {

/// A variant on a chain, from nothing to the pairs.
struct Run {
  std::string name;
  std::unique_ptr<Variant> variant;
  double ms(const Chain& chain, Collisions& found) const {
    return blaming(name, [&] {
      const Stopwatch watch;
      variant->build(chain);
      variant->find(chain, {}, found);
      return watch.ms();
    });
  }
};

/// What auto took beside the quickest single variant of the host, on the first chain of each input: which of
/// them is the quickest is found first, by a few runs of each, and then the two run in random turns.
nlohmann::ordered_json regret(const Profile& profile) {
  struct Case {
    std::shared_ptr<const bench::Workload> work;
    std::vector<Run> runs;
  };
  std::vector<Case> cases;
  for_each_host_variant(profile,
                        [&](const bench::Workload& work, const Chain& chain, const VariantInfo& info) {
                          if (cases.empty() || cases.back().work->label != work.label)
                            cases.push_back({bench::workload(work.spec), {}});
                          Run run{info.name, work.make(info.name)};
                          Collisions found;
                          run.ms(chain, found);
                          cases.back().runs.push_back(std::move(run));
                        });
  auto rows = nlohmann::ordered_json::array();
  for (const auto& [work, runs] : cases) {
    const auto planned = std::ranges::find(runs, "auto", &Run::name);
    if (planned == runs.end() || runs.size() < 2) continue;
    const Chain& chain = work->chains.front();
    Collisions found;
    const auto in_turns = [&](const std::vector<const Run*>& of, std::size_t rounds) {
      std::vector<std::function<double()>> each;
      for (const Run* run : of) each.emplace_back([&, run] { return run->ms(chain, found); });
      return bench::interleave(each, rounds, profile.section_seconds / 4, profile.stopping.seed);
    };
    std::vector<const Run*> others;
    for (const Run& run : runs)
      if (&run != &*planned) others.push_back(&run);
    const auto tried = in_turns(others, 3);
    const auto best = others[static_cast<std::size_t>(
        std::ranges::min_element(tried, {},
                                 [](const auto& ms) { return bench::median_interval(ms).median; }) -
        tried.begin())];
    const auto ms = in_turns({&*planned, best}, 2 * profile.section_rounds);
    rows.push_back({{"input", work->label},
                    {"chosen", planned->variant->answered_by()},
                    {"best", best->name},
                    {"auto_ms", ms[0]},
                    {"best_ms", ms[1]}});
  }
  return rows;
}

const RegisterSection registered{"regret", regret};

}  // namespace
}  // namespace catena::reports
