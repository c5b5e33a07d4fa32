#pragma once
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "catena/bench/regret/regret.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/error.h"
#include "catena/reports/run_file.h"

// A small run, which tests of it share.
namespace catena::reports {

using Json = nlohmann::ordered_json;

/// Every section, small.
inline Profile small_profile() {
  Profile p = profile_named("quick");
  std::erase_if(p.variants, [](const VariantInfo& v) {
    return !std::set<std::string>{"CPU1",       "CPU1/literal", "aCPU2+CPU2", "aCPU2+CPU2/literal",
                                  "aCPU2+Dual", "Hybrid",       "auto"}
                .contains(v.name);
  });
  bench::WorkloadSpec in_box{CATENA_SOURCE_DIR "/core/readers/examples/melt.dump"};  // a box, two frames
  in_box.options.radius = 0.5f;
  p.inputs = {{"path1:n=300"}, {"path1:n=100", true}, in_box};
  p.long_inputs = {{"path1:n=500"}};
  p.stopping = {.seconds = 60, .share = 0, .most_samples = 2, .least_ms = 0.01, .seed = 5};
  p.section_seconds = 0.01;
  p.section_rounds = 3;
  p.stability_n = 200;  // the rope diverges when it is much shorter
  p.tube_spacings = {1};
  p.motion_steps.clear();
  p.examine_settings = {"n=200"};
  p.shown = {{"path1:n=200", true}, {"far:n=500,exponent=22"}, {"hair:n=200"}};
  p.wants_inputs = p.coherent_inputs = {bench::WorkloadSpec{"path1:n=200"}, in_box};
  p.regret_inputs = {bench::WorkloadSpec{"path1:n=16"}, bench::WorkloadSpec{"yarn:n=300"}, in_box};
  p.short_chains = {10, 100};
  p.animation_input = {"path1:n=200"};
  p.animation_step = 10;
  p.keyframe_sizes = {200};
  p.copy_bytes = 1 << 20;
  p.rank_chains = {{"yarn:n=1000", 8}, {"hair:n=1000", 4}};
  return p;
}

inline bool measures() {
  if (!measures_in_this_build()) return false;
  try {
    bench::measure_in_rounds({}, {});
    return true;
  } catch (const InputError&) {
    return false;
  }
}

inline const Json& small_run() {
  static const Json run = measure_run(small_profile(), "catena report --quick");
  return run;
}

class RunFile : public testing::Test {
 protected:
  void SetUp() override {
    if (!measures()) GTEST_SKIP() << "measures in a Release build with Google Benchmark only";
  }
};

}  // namespace catena::reports
