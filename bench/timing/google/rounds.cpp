#include "catena/bench/timing/google/rounds.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "catena/bench/timing/calibration.h"
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
  Measurement(const std::vector<Case>& cases, double least_ms, const RowTaker& taker)
      : least_seconds_(least_ms / 1000), taker_(taker) {
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

  /// Goes on from the rows of an interrupted measurement.
  Samples resume(const nlohmann::ordered_json& rows) {
    std::map<std::string, std::size_t> run_of;
    for (std::size_t k = 0; k < timed_.size(); ++k) run_of[timed_[k].what->name() + "/manual_time"] = k;
    Samples samples{std::vector<std::vector<double>>(timed_.size()), 0, std::vector<bool>(timed_.size())};
    for (const auto& row : rows) {
      const auto known = run_of.find(row.at("name"));
      if (known == run_of.end()) continue;  // the cases are others now
      Timed& timed = timed_[known->second];
      if (row.value("error_occurred", false)) {
        timed.refused = samples.failed[known->second] = true;
      } else {
        samples.ms[known->second].push_back(row.at("real_time"));
        timed.iterations = row.at("iterations");
        ++timed.samples;
      }
      samples.rounds = std::max(samples.rounds, row.at("repetition_index").get<std::size_t>() + 1);
      rows_.emplace_back(known->second, row);
    }
    return samples;
  }

  std::optional<double> take(const Turn& turn) {
    current_ = &timed_[turn.run];
    if (turn.place == 0) progress_.emplace(turn.places);
    progress_->step(current_->what->name());
    if (live_ && (turn.place == 0 || live_ != current_->trial)) live_->release();
    live_ = current_->trial;
    ms_.reset();
    benchmark::ClearRegisteredBenchmarks();
    enlist(*current_);
    if (current_->trial->prepare().empty()) load_ = measured_load();
    benchmark::RunSpecifiedBenchmarks(this, ".");
    return ms_;
  }

  Rounds result(const Samples& samples, double share) {
    progress_.reset();
    benchmark::ClearRegisteredBenchmarks();
    if (live_) live_->release();
    Rounds out;
    out.context = context();
    out.benchmarks = nlohmann::ordered_json::array();
    for (auto& [run, row] : rows_) {
      if (row.value("at_fault", false)) note_fault(*timed_[run].what, row["error_message"], out.faults);
      row["repetitions"] = std::max<std::int64_t>(1, timed_[run].samples);
      out.benchmarks.push_back(std::move(row));
    }
    out.rounds = samples.rounds;
    for (std::size_t k = 0; k < timed_.size(); ++k) {
      if (samples.ms[k].empty() && !timed_[k].refused) out.not_reached.push_back(timed_[k].what->name());
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
  static void note_fault(const Case& what, const std::string& reason, std::vector<std::string>& faults) {
    std::string fault = what.variant.name + " on " + what.facts.label + ": " + reason;
    if (std::ranges::find(faults, fault) == faults.end()) faults.push_back(std::move(fault));
  }

  static nlohmann::ordered_json context() {
    std::ostringstream text;
    benchmark::JSONReporter json;
    json.SetOutputStream(&text), json.SetErrorStream(&text);
    json.ReportContext({});
    json.Finalize();
    return std::move(nlohmann::ordered_json::parse(text.str())["context"]);
  }

  /// What Google Benchmark writes of one run; the same text as among others.
  static nlohmann::ordered_json row_of(const Run& run) {
    std::ostringstream text;
    benchmark::JSONReporter json;
    json.SetOutputStream(&text), json.SetErrorStream(&text);
    json.ReportRuns({run});
    return nlohmann::ordered_json::parse(text.str());
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
        run.counters["load_one_ms"] = load_.one_ms;
        run.counters["load_all_ms"] = load_.all_ms;
        ++current_->samples;
        ms_ = run.GetAdjustedRealTime();
      }
      rows_.emplace_back(static_cast<std::size_t>(run.family_index), row_of(run));
      if (failed(run) && current_->trial->at_fault()) rows_.back().second["at_fault"] = true;
      if (taker_) taker_(rows_.back().second);
    }
  }

  const double least_seconds_;  // of one sample
  const RowTaker& taker_;
  std::vector<Timed> timed_;
  Groups groups_;
  std::vector<std::pair<std::size_t, nlohmann::ordered_json>> rows_;  // each with the number of its case
  Timed* current_ = nullptr;
  std::optional<double> ms_;  // of the sample just taken; none: refused
  std::shared_ptr<Trial> live_;
  std::optional<Progress> progress_;
  Load load_;  // just before that sample
};

}  // namespace

Rounds measure_in_rounds(const std::vector<Case>& cases, const Stopping& stopping, const RowTaker& taker,
                         const nlohmann::ordered_json& earlier) {
  Measurement measurement(cases, stopping.least_ms, taker);
  Samples before = measurement.resume(earlier);
  const Samples samples = sample_in_rounds(
      measurement.groups(), stopping, [&](const Turn& turn) { return measurement.take(turn); },
      std::move(before));
  return measurement.result(samples, stopping.share);
}

}  // namespace catena::bench
