#include "catena/bench/timing/google/rounds.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "catena/bench/timing/google/benchmarks.h"
#include "catena/core/commands/progress.h"

namespace catena::bench {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

/// Whether a run ended in an error: `skipped` since Google Benchmark 1.8, `error_occurred` before.
template <class AnyRun>
bool failed(const AnyRun& run) {
  if constexpr (requires { run.skipped; })
    return run.skipped != 0;
  else
    return run.error_occurred;
}

/// Takes one sample at a time with Google Benchmark, and keeps its rows.
class Measurement final : public benchmark::BenchmarkReporter {
 public:
  Measurement(const std::vector<Case>& cases, double least_ms) : least_seconds_(least_ms / 1000) {
    std::map<std::string, std::size_t> input_of;
    std::map<std::string, std::shared_ptr<Trial>> trials;
    for (const Case& c : cases) {
      const auto [input, new_input] = input_of.try_emplace(c.facts.label, groups_.size());
      if (new_input) groups_.emplace_back();
      auto& trial = trials[c.facts.label + "/" + c.variant.name];
      if (!trial) {
        trial = std::make_shared<Trial>(c.spec, c.variant);
        groups_[input->second].emplace_back();
      }
      groups_[input->second].back().push_back(timed_.size());
      timed_.push_back({&c, trial});
      if (c.spec.all_frames) timed_.back().iterations = c.facts.frames;
    }
  }

  /// Of each input, of each variant on it, its stages.
  const Groups& groups() const { return groups_; }

  std::optional<double> take(const Turn& turn) {
    current_ = &timed_[turn.run];
    if (turn.place == 0) progress_.emplace(turn.places);
    progress_->step(current_->what->name());
    if (live_ && (turn.place == 0 || live_ != current_->trial)) live_->release();
    live_ = current_->trial;
    ms_.reset();
    benchmark::ClearRegisteredBenchmarks();
    enlist(*current_);
    benchmark::RunSpecifiedBenchmarks(this, ".");
    return ms_;
  }

  Rounds result(const Samples& samples, double share) {
    progress_.reset();
    benchmark::ClearRegisteredBenchmarks();
    if (live_) live_->release();
    Rounds out;
    std::ostringstream text;
    benchmark::JSONReporter json;
    json.SetOutputStream(&text);
    json.SetErrorStream(&text);
    json.ReportContext({});
    for (Run& run : runs_)
      run.repetitions = std::max<std::int64_t>(1, timed_[static_cast<std::size_t>(run.family_index)].samples);
    json.ReportRuns(runs_);
    json.Finalize();
    auto parsed = nlohmann::ordered_json::parse(text.str());
    out.context = std::move(parsed["context"]);
    out.benchmarks = std::move(parsed["benchmarks"]);
    out.rounds = samples.rounds;
    for (std::size_t k = 0; k < timed_.size(); ++k) {
      if (samples.ms[k].empty() && !timed_[k].refused) out.not_reached.push_back(timed_[k].what->name());
      note_fault(*timed_[k].trial, timed_[k].what->facts.label, out.faults);
      out.cases += !samples.ms[k].empty();
      out.narrow += narrow(samples.ms[k], share);
    }
    return out;
  }

 private:
  struct Timed {
    const Case* what;
    std::shared_ptr<Trial> trial;
    benchmark::IterationCount iterations = 0;  // of one sample; 0: not known yet
    std::int64_t samples = 0;
    bool refused = false;
  };

  /// Once for all stages.
  static void note_fault(const Trial& trial, const std::string& input, std::vector<std::string>& faults) {
    if (!trial.at_fault()) return;
    std::string fault = trial.info().name + " on " + input + ": " + trial.reason();
    if (std::ranges::find(faults, fault) == faults.end()) faults.push_back(std::move(fault));
  }

  void enlist(const Timed& timed) {
    auto* registered = benchmark::RegisterBenchmark(
        timed.what->name().c_str(),
        [&timed](benchmark::State& state) { measure(state, *timed.trial, timed.what->stage); });
    registered->UseManualTime()->Unit(benchmark::kMillisecond);
    if (timed.iterations > 0)
      registered->Iterations(timed.iterations);
    else
      registered->MinTime(least_seconds_);
  }

  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& reported) override {
    for (Run run : reported) {
      if (run.run_type != Run::RT_Iteration) continue;
      run.run_name.min_time.clear();
      run.run_name.iterations.clear();
      run.family_index = current_ - timed_.data();
      run.per_family_instance_index = 0;
      run.repetition_index = current_->samples;
      if (failed(run)) {
        current_->refused = true;
      } else {
        current_->iterations = run.iterations;
        ++current_->samples;
        ms_ = run.GetAdjustedRealTime();
      }
      runs_.push_back(std::move(run));
    }
  }

  const double least_seconds_;  // of one sample
  std::vector<Timed> timed_;
  Groups groups_;
  std::vector<Run> runs_;
  Timed* current_ = nullptr;
  std::optional<double> ms_;  // of the sample just taken; none: refused
  std::shared_ptr<Trial> live_;
  std::optional<Progress> progress_;
};

}  // namespace

Rounds measure_in_rounds(const std::vector<Case>& cases, const Stopping& stopping) {
  Measurement measurement(cases, stopping.least_ms);
  const Samples samples = sample_in_rounds(measurement.groups(), stopping,
                                           [&](const Turn& turn) { return measurement.take(turn); });
  return measurement.result(samples, stopping.share);
}

}  // namespace catena::bench
