#include "catena/reports/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "catena/bench/regret/regret.h"
#include "catena/core/error.h"

namespace catena::reports {
namespace {

using bench::WorkloadSpec;

/// The paper's Tables 3 and 4.
constexpr std::array paper_sizes{10'000, 20'000, 30'000, 40'000, 50'000, 100'000, 150'000};
constexpr std::array paper_variants{"GPU1", "aCPU2+CPU2", "aGPU2+GPU2", "aGPU2+GPUv2"};

std::vector<VariantInfo> available() {
  auto variants = StrategyRegistry::instance().variants();
  std::erase_if(variants, [](const VariantInfo& v) { return v.unavailable.has_value(); });
  return variants;
}

std::vector<WorkloadSpec> over_n(const std::string& scene, std::initializer_list<std::uint32_t> sizes) {
  std::vector<WorkloadSpec> specs;
  for (const std::uint32_t n : sizes) specs.push_back({fmt::format("{}:n={}", scene, n)});
  return specs;
}

void append(std::vector<WorkloadSpec>& to, std::vector<WorkloadSpec> more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// In binary64 only where the error is the question: in the stability matrix and against run time.
Profile quick() {
  Profile p;
  p.inputs = over_n("path1", {1000, 2000, 5000, 10'000, 20'000});
  append(p.inputs, over_n("path2", {10'000}));
  append(p.inputs, over_n("yarn", {1000, 2000, 5000, 10'000}));
  append(p.inputs, over_n("mixed_radii", {5000}));
  p.long_inputs = over_n("path1", {1'000'000});  // 16 MB, more than an L2 holds
  p.filter = "-/double/";
  p.most_all_pairs = 10'000;  // the paper's claim of CPU1 is at 10,000
  p.stopping = {.seconds = 90, .share = 0.05, .most_samples = 12, .least_ms = 2, .seed = 1};
  p.whole_seconds = 160;
  p.section_seconds = 2;
  p.section_rounds = 11;
  p.stability_n = 200;
  p.motion_stiffnesses = {1e4};
  p.motion_steps = {0.25};  // where an exact motion holds from nearly all starts: a verdict can be had
  p.motion_offsets = {1e7, 0};
  p.motion_starts = 32;
  p.motion_seconds = 15;
  p.keyframe_sizes = {10'000};
  p.copy_bytes = 256 << 20;
  p.tubes = {"lissajous"};
  p.tube_spacings = {2, 1, 0.5, 0.25, 0.125};
  p.examine_settings = {"n=1000", "n=10000", "n=10000,offset=1e3", "n=10000,offset=1e5",
                        "n=10000,offset=1e6"};
  p.shown = {{"path1:n=2000", true},
             {"yarn:n=5000"},
             {"path1:n=20000"},
             {"far:n=2000,exponent=22"},
             {"lattice_moved:n=1000"}};
  p.judged_steps = 8;
  p.judged_side = 30;
  p.judged_n = 32'000;
  p.judged_moves = 20'000;
  p.rank_chains = {{"yarn:n=20000", 256},   {"yarn:n=100000", 4096},   {"hair:n=20000", 256},
                   {"hair:n=100000", 1024}, {"lattice:n=100000", 256}, {"path2:n=100000", 256}};
  p.wants_inputs = over_n("path1", {10'000});
  append(p.wants_inputs, over_n("yarn", {5000}));
  p.coherent_inputs = over_n("path1", {10'000});
  p.planned_inputs = {"path1:n=20", "path1:n=10000", "yarn:n=10000", "cluster:n=10000"};
  p.regret_inputs = over_n("path1", {4, 16, 100});
  append(p.regret_inputs, bench::all_scenes(1000));
  p.short_chains = {10, 30, 100, 300, 1000, 3000};
  p.animation_input = {"path1:n=5000"};
  p.animation_step = 2;
  return p;
}

Profile full() {
  Profile p = quick();
  p.inputs = over_n("path1", {1000, 3000, 10'000, 30'000, 100'000, 150'000, 1'000'000});
  append(p.inputs, over_n("path2", {1000, 3000, 10'000, 30'000, 100'000, 150'000, 1'000'000}));
  append(p.inputs, over_n("yarn", {1000, 3000, 10'000, 30'000, 100'000}));
  append(p.inputs, over_n("mixed_radii", {10'000, 100'000}));
  append(p.inputs, over_n("hair", {10'000, 100'000}));
  append(p.inputs, over_n("winding", {10'000}));
  p.long_inputs.clear();  // they are among the inputs
  p.stopping = {.seconds = 3600, .share = 0.02, .most_samples = 50, .least_ms = 10, .seed = 1};
  p.filter.clear();
  p.most_all_pairs = 20'000;
  p.whole_seconds = 0;
  p.section_seconds = 20;
  p.section_rounds = 31;
  p.motion_stiffnesses = {1e4, 1e2, 1e6, 1e9};
  p.motion_steps = {0.5, 0.25, 1, 2};
  p.motion_offsets = {1e7, 4e6, 0};
  p.motion_seconds = 900;
  p.keyframe_sizes.assign(paper_sizes.begin(), paper_sizes.end());
  p.tubes = {"lissajous", "torus_knot_2_3"};
  p.tube_spacings = {2, 1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
  p.examine_settings.insert(p.examine_settings.end(), {"n=100000", "n=10000,offset=1e7"});
  p.stability_n = 1000;
  p.judged_steps = 11;
  p.judged_side = 100;
  p.judged_n = 1'000'000;
  p.judged_moves = 2'000'000;
  p.rank_chains = {{"yarn:n=30000", 1024},  {"yarn:n=300000", 4096}, {"yarn:n=3000000", 256},
                   {"hair:n=30000", 1024},  {"hair:n=300000", 4096}, {"lattice:n=300000", 1024},
                   {"path2:n=300000", 1024}};
  p.wants_inputs = over_n("path1", {10'000, 100'000});
  append(p.wants_inputs, over_n("yarn", {5000, 50'000}));
  append(p.wants_inputs, over_n("winding", {5000}));
  p.coherent_inputs = over_n("path1", {10'000, 100'000});
  append(p.coherent_inputs, over_n("path2", {100'000}));
  for (const std::uint32_t n : {30'000, 1'000'000}) append(p.regret_inputs, bench::all_scenes(n));
  p.planned_inputs = {"path1:n=20"};
  for (const WorkloadSpec& scene : bench::all_scenes(10'000)) p.planned_inputs.push_back(scene.input);
  p.short_chains = {10, 20, 50, 100, 200, 500, 1000, 2000, 5000};
  p.animation_input = {"path1:n=20000"};
  p.animation_step = 1;
  return p;
}

/// The paper's tables: both paths, its seven sizes, every keyframe. What a device would run is run by the
/// host where there is no device, and named so.
Profile paper() {
  Profile p;
  for (const char* path : {"path1", "path2"})
    for (const int n : paper_sizes) p.inputs.push_back({fmt::format("{}:n={}", path, n), true});
  const auto all = available();
  for (const std::string name : paper_variants)
    for (const char* arithmetic : {"", "/literal"}) {
      const auto found = std::ranges::find(all, name + arithmetic, &VariantInfo::name);
      if (found != all.end()) p.variants.push_back(*found);
    }
  if (std::ranges::none_of(p.variants, &VariantInfo::on_device))
    for (const auto& v : all)
      for (const char* twin : {"GPU1@host", "aGPU2@host+GPU2@host", "aGPU2@host+GPUv2@host"})
        if (v.name == twin || v.name == std::string(twin) + "/literal") p.variants.push_back(v);
  p.keyframe_sizes.assign(paper_sizes.begin(), paper_sizes.end());
  p.filter = "-/(whole|update)";  // the tables have construction and traversal
  p.most_all_pairs = 10'000;
  p.stopping = {.seconds = 3600, .share = 0.02, .most_samples = 20, .least_ms = 10, .seed = 1};
  return p;
}

}  // namespace

Profile profile_named(const std::string& name) {
  Profile p = name == "paper" ? paper() : name == "full" ? full() : quick();
  if (name != "paper" && name != "full" && name != "quick")
    throw InputError(fmt::format("there is no profile '{}'; there are: quick, full, paper", name));
  p.name = name;
  if (p.variants.empty()) p.variants = available();
  return p;
}

std::vector<VariantInfo> exact_variants(const Profile& profile) {
  auto variants = profile.variants;
  std::erase_if(variants, [](const VariantInfo& v) { return !v.exact; });
  return variants;
}

}  // namespace catena::reports
