#include "catena/bench/timing/google/rounds.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <random>
#include <sstream>

#include "catena/bench/timing/google/benchmarks.h"
#include "catena/bench/timing/median_interval.h"
#include "catena/core/commands/progress.h"
#include "catena/core/input/input.h"

namespace catena::bench {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

/// A case and what was measured of it so far.
struct Sampled {
  const Case* what;
  std::shared_ptr<Trial> trial;
  benchmark::IterationCount iterations = 0;  // of one sample; 0: not known yet
  std::vector<double> ms = {};
  bool done = false, failed = false;
};

class Measurement final : public benchmark::BenchmarkReporter {
 public:
  Measurement(const std::vector<Case>& cases, const Stopping& stopping)
      : stopping_(stopping), random_(stopping.seed) {
    std::map<std::string, std::size_t> input_of;
    std::map<std::string, std::shared_ptr<Trial>> trials;
    for (const Case& c : cases) {
      const std::string label = label_of(c.spec);
      const auto [input, new_input] = input_of.try_emplace(label, inputs_.size());
      if (new_input) inputs_.emplace_back();
      auto& trial = trials[label + "/" + c.variant.name];
      if (!trial) {
        trial = std::make_shared<Trial>(c.spec, c.variant);
        inputs_[input->second].emplace_back();
      }
      inputs_[input->second].back().push_back(sampled_.size());
      sampled_.push_back({&c, trial});
      if (c.spec.all_frames) sampled_.back().iterations = open_input(c.spec.input).animation->frames();
    }
  }

  void round() {
    std::ranges::shuffle(inputs_, random_);
    benchmark::ClearRegisteredBenchmarks();
    std::size_t registered = 0;
    for (auto& units : inputs_) {
      std::ranges::shuffle(units, random_);
      for (const auto& unit : units)
        for (const std::size_t k : unit)
          if (!sampled_[k].done) enlist(k), ++registered;
    }
    ++rounds_;
    Progress progress(registered);
    progress_ = &progress;
    if (registered > 0) benchmark::RunSpecifiedBenchmarks(this, ".");
    progress_ = nullptr;
    benchmark::ClearRegisteredBenchmarks();
    if (live_) live_->release();
    live_.reset();
  }

  bool finished() const {
    return late() || std::ranges::all_of(sampled_, [](const Sampled& s) { return s.done; });
  }

  Rounds result() {
    Rounds out;
    std::ostringstream text;
    benchmark::JSONReporter json;
    json.SetOutputStream(&text);
    json.SetErrorStream(&text);
    json.ReportContext({});
    for (std::size_t k = 0; k < runs_.size(); ++k)
      runs_[k].repetitions =
          std::max<std::int64_t>(1, static_cast<std::int64_t>(sampled_[case_of_[k]].ms.size()));
    json.ReportRuns(runs_);
    json.Finalize();
    auto parsed = nlohmann::ordered_json::parse(text.str());
    out.context = std::move(parsed["context"]);
    out.benchmarks = std::move(parsed["benchmarks"]);
    out.rounds = rounds_;
    for (const Sampled& s : sampled_) {
      if (s.ms.empty() && !s.failed) out.not_reached.push_back(s.what->name());
      out.cases += !s.ms.empty();
      out.narrow += narrow(s);
    }
    return out;
  }

 private:
  bool late() const { return watch_.ms() > 1000 * stopping_.seconds; }

  bool narrow(const Sampled& s) const {
    return !s.ms.empty() && median_interval(s.ms).relative_width() < stopping_.share;
  }

  void enlist(std::size_t k) {
    Sampled& s = sampled_[k];
    auto* registered = benchmark::RegisterBenchmark(s.what->name().c_str(),
                                                    [this, k](benchmark::State& state) { sample(state, k); });
    registered->UseManualTime()->Unit(benchmark::kMillisecond);
    if (s.iterations > 0)
      registered->Iterations(s.iterations);
    else
      registered->MinTime(stopping_.least_ms / 1000);
  }

  void sample(benchmark::State& state, std::size_t k) {
    Sampled& s = sampled_[k];
    if (current_ != k) progress_->step(s.what->name());
    current_ = k;
    too_late_ = late();
    if (too_late_) return state.SkipWithError("no time left");
    if (live_ && live_ != s.trial) live_->release();
    live_ = s.trial;
    measure(state, *s.trial, s.what->stage);
  }

  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& reported) override {
    if (too_late_) return;
    Sampled& s = sampled_[current_];
    for (Run run : reported) {
      if (run.run_type != Run::RT_Iteration) continue;
      run.run_name.min_time.clear();
      run.run_name.iterations.clear();
      run.family_index = static_cast<std::int64_t>(current_);
      run.per_family_instance_index = 0;
      run.repetition_index = static_cast<std::int64_t>(s.ms.size());
      if (run.error_occurred) {
        s.done = s.failed = true;
      } else {
        s.iterations = run.iterations;
        s.ms.push_back(run.GetAdjustedRealTime());
        s.done = s.ms.size() >= stopping_.most_samples || narrow(s);
      }
      runs_.push_back(std::move(run));
      case_of_.push_back(current_);
    }
  }

  const Stopping stopping_;
  const Stopwatch watch_;
  std::mt19937_64 random_;
  std::vector<Sampled> sampled_;
  std::vector<std::vector<std::vector<std::size_t>>> inputs_;  // of each input, of each trial, its cases
  std::vector<Run> runs_;
  std::vector<std::size_t> case_of_;  // of each run
  std::size_t rounds_ = 0, current_ = ~std::size_t{0};
  bool too_late_ = false;
  std::shared_ptr<Trial> live_;
  Progress* progress_ = nullptr;
};

}  // namespace

Rounds measure_in_rounds(const std::vector<Case>& cases, const Stopping& stopping) {
  Measurement measurement(cases, stopping);
  do measurement.round();
  while (!measurement.finished());
  return measurement.result();
}

}  // namespace catena::bench
