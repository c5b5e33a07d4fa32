#include "catena/core/plan/run_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "catena/core/counted.h"
#include "catena/core/percent.h"
#include "catena/core/plan/omissions.h"

namespace catena {
namespace {

Decision* step_of(Omission omission, Plan& steps) {
  const auto found = std::ranges::find(steps, info_of(omission).step, &Decision::step);
  return found != steps.end() ? &*found : nullptr;
}

Decision took(const char* step, std::string reason, double ms) {
  return {step, false, std::move(reason), std::nullopt, ms};
}

std::string planning(const RunAccount& run, double whole_ms) {
  const auto share = [&](double ms) {
    return whole_ms > 0 ? percent(ms / whole_ms) + " of build and search" : "of a search of nothing";
  };
  return run.planning_again_ms
             ? fmt::format("once more {:.3g} ms, {}: a first time in a program starts its threads",
                           *run.planning_again_ms, share(*run.planning_again_ms))
             : share(*run.planning_ms);
}

/// "of 190 pairs of spheres: each", or how often each step of the search was taken.
std::string met(std::uint32_t spheres, const RunAccount::Searcher& by) {
  const std::uint64_t n = spheres;
  std::string text = "of " + counted(n < 2 ? 0 : n * (n - 1) / 2, "pair") + " of spheres";
  if (by.all_pairs) return text + ": each";
  const char* before = ": ";
  for (const WorkDone& work : by.work)
    if (work.times > 0)
      text += fmt::format("{}{} {}", std::exchange(before, "; "), work.step, counted(work.times, "time"));
  return text;
}

}  // namespace

void tell_run(const RunAccount& run, Plan& steps) {
  const double whole_ms = run.took.build_ms + run.took.find_ms + run.took.transfer_ms;
  if (!steps.empty()) steps.front().actual_ms = whole_ms;
  if (Decision* const look = step_of(Omission::other_places, steps); look != nullptr && look->left_out)
    look->actual_ms = run.look_ms;
  if (Decision* const list = step_of(Omission::pair_list, steps);
      list != nullptr && list->left_out && run.unlisted)
    list->removed = counted(*run.unlisted, "pair");
  if (run.planning_ms && !steps.empty())
    steps.insert(steps.begin() + 1, took("planning", planning(run, whole_ms), *run.planning_ms));
  if (!run.searcher) return;
  const RunAccount::Searcher& by = *run.searcher;
  if (Decision* const tree = step_of(Omission::hierarchy, steps))
    tree->actual_ms = tree->left_out ? by.took.build_ms + by.took.find_ms : by.took.build_ms;
  steps.push_back(took("build", by.name, by.took.build_ms));
  steps.push_back(took("search", met(run.spheres, by), by.took.find_ms));
  if (by.took.transfer_ms > 0)
    steps.push_back(took("moves between memories", "chain there, answer back", by.took.transfer_ms));
  if (by.took.start_ms > 0)
    steps.push_back(took("start of the device", "of a first call, besides", by.took.start_ms));
}

}  // namespace catena
