#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "catena/core/plan/omissions.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"
#include "catena/bench/timing/workload.h"
#include "catena/reports/faults.h"
#include "catena/reports/saving.h"

namespace catena::reports {
namespace {

using Want = Request::Want;

/// Chains that are searched one after the other, over and over, as the same variant's frames where there are
/// several, each alone where there is one.
struct Task {
  std::string what;  ///< of it, for the reader
  Request request;
  std::vector<Chain> frames;
};

/// The variant auto, and in which frame of a task it stands.
class Planned {
 public:
  Planned(const std::string& name, const Task& task)
      : task_(task), variant_(StrategyRegistry::instance().make(name)) {
    variant_->prepare(task.request);
    variant_->build(task.frames.front());
    variant_->find(task.frames.front(), task.request, found_);
  }
  /// The next frame, or the only one from nothing; its wall time.
  double run() {
    at_ = (at_ + 1) % task_.frames.size();
    const Chain& chain = task_.frames[at_];
    const Stopwatch watch;
    task_.frames.size() > 1 ? variant_->update(chain) : variant_->build(chain);
    variant_->find(chain, task_.request, found_);
    return watch.ms();
  }
  Plan plan() const { return variant_->plan(); }
  Collisions found() const {
    Collisions sorted = found_;
    std::ranges::sort(sorted.pairs);
    return sorted;
  }

 private:
  const Task& task_;
  std::unique_ptr<Variant> variant_;
  Collisions found_;
  std::size_t at_ = 0;
};

bool same(const Collisions& a, const Collisions& b) {
  return a.found == b.found && a.pair_count == b.pair_count && a.count == b.count && a.pairs == b.pairs;
}

/// The frame with a hundredth of its spheres in the places of others.
Chain partly_moved(const Chain& chain) {
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  const std::size_t moved = spheres.size() / 100, begin = spheres.size() / 2;
  std::rotate(spheres.begin() + begin, spheres.begin() + begin + moved / 2, spheres.begin() + begin + moved);
  return chain.moved(std::move(spheres));
}

/// Every sphere a fiftieth of its radius aside, to and fro.
Chain shaken(const Chain& chain) {
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  for (std::size_t i = 0; i < spheres.size(); ++i)
    (i % 2 ? spheres[i].x : spheres[i].y) += (i % 4 < 2 ? 0.02f : -0.02f) * spheres[i].radius;
  return chain.moved(std::move(spheres));
}

std::vector<Task> tasks_of(const bench::Workload& work) {
  const Chain& chain = work.chains.front();
  Request frames;
  frames.frames_follow = true;
  std::vector<Task> tasks{{"", {}, {chain}},
                          {", only counts", {.want = Want::counts}, {chain}},
                          {", only yes or no", {.want = Want::any}, {chain}},
                          {", unmoved frames", frames, {chain, chain}},
                          {", a hundredth moved", frames, {chain, partly_moved(chain)}},
                          {", shaken by 0.02 radii", frames, {chain, shaken(chain)}}};
  if (work.beside) tasks.push_back({", the next frame", frames, {*work.beside, chain}});
  return tasks;
}

bool left_out(const Plan& plan, const std::string& step) {
  const auto found = std::ranges::find(plan, step, &Decision::step);
  return found != plan.end() && found->left_out;
}

/// What auto left out of this task and of none before it, each with what it costs to do it. What is left out
/// all the same (no device is there) saves nothing.
void add_task(nlohmann::ordered_json& rows, const bench::Workload& work, const Task& task,
              std::set<std::string>& seen, const Profile& profile) {
  Planned all("auto", task);
  for (std::size_t k = 0; k < 4 * task.frames.size(); ++k) all.run();  // until it knows what pays
  for (const Decision& step : all.plan()) {
    const auto omission = std::ranges::find(all_omissions(), step.step, &OmissionInfo::step);
    if (!step.left_out || omission == all_omissions().end() || seen.contains(step.step)) continue;
    Planned kept(fmt::format("auto(keep={})", omission->name), task);
    for (std::size_t k = 0; k < task.frames.size(); ++k) kept.run(), all.run();
    if (left_out(kept.plan(), step.step)) continue;
    seen.insert(step.step);
    Planned fresh("auto", task);
    Planned fresh_kept(fmt::format("auto(keep={})", omission->name), task);
    fresh.run(), fresh_kept.run();
    rows.push_back(saving(work.label, step.step + task.what,
                          fmt::format("{} (--no-omit {})", step.reason, omission->name),
                          same(fresh.found(), fresh_kept.found()), [&] { return kept.run(); },
                          [&] { return all.run(); }, profile));
  }
}

}  // namespace

void add_planned_savings(nlohmann::ordered_json& rows, const Profile& profile) {
  const auto variants = exact_variants(profile);
  if (std::ranges::find(variants, "auto", &VariantInfo::name) == variants.end()) return;
  for (const auto& spec : profile.planned_inputs) {
    const auto work = bench::workload({spec});
    std::set<std::string> seen;
    for (const Task& task : tasks_of(*work))
      attempt("auto", [&] { add_task(rows, *work, task, seen, profile); });
  }
}

}  // namespace catena::reports
