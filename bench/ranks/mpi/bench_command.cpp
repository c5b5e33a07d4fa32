#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/usable_cores.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/mpi/mpi_launcher.h"
#include "catena/core/ranks/mpi/phase_peaks.h"
#include "catena/core/ranks/mpi/rank_options.h"
#include "catena/core/ranks/mpi/shared_input.h"
#include "catena/core/ranks/phase_clock.h"
#include "catena/core/ranks/rank_input.h"

namespace catena::ranks {
namespace {

/// On large pages, as what is read of a file.
template <class Value>
std::vector<Value> copy_of(const std::vector<Value>& values) {
  std::vector<Value> copy;
  resize_large(copy, values.size());
  std::ranges::copy(values, copy.begin());
  return copy;
}

Part copy_of(const Part& part) {
  return {part.rule, copy_of(part.spheres), part.pieces, copy_of(part.arcs), part.extra};
}

/// `mpirun -n K catena bench INPUT`: how long the ranks take, phase by phase, and what they tell one another.
class BenchCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", input_, "A scene or a file").required();
    app.add_option("--repetitions", repetitions_, "Searches, of which the median is told")
        .range(1, 1000)
        .capture_default_str();
    search_.add_to(app);
    search_.add_input_to(app);
    app.add_flag("--json", json_, "As without it: one JSON object");
  }

  int run() override {
    RankOptions options = search_.of({.want = Request::Want::counts});
    options.entering = [this](Phase phase) {
      clock_.enter(phase);
      peaks_.enter(phase);
    };
    together(ranks_, [&] {
      const RankInput input(ranks_, input_, search_.input(), open_shared);
      Part part = input.part(0).part;
      const std::optional<PeriodicBox> box = input.box(0);
      const auto search_in = [&](Part own, RankWork& work) {
        return search_frame(ranks_, input, 0, box, std::move(own), options, work);
      };
      for (unsigned k = 0; k < repetitions_; ++k) {
        const bool last = k + 1 == repetitions_;  // then no copy is left to be held beside
        search_once(last ? std::move(part) : copy_of(part), search_in, box, last);
      }
    });
    return 0;
  }

 private:
  /// Of the slowest rank in each phase, and of the whole search.
  struct Times {
    PhaseClock::Milliseconds ms;
    double whole;
  };

  template <class Search>
  void search_once(Part own, const Search& search_in, const std::optional<PeriodicBox>& box, bool last) {
    clock_ = {};
    RankWork work;
    const Traffic before = ranks_.traffic();
    ranks_.vote();  // all begin at once
    const auto began = std::chrono::steady_clock::now();
    const RankAnswer answer = search_in(std::move(own), work);
    const std::chrono::duration<double, std::milli> whole = std::chrono::steady_clock::now() - began;
    Times slowest{};
    for (const Times& times : all_gather_value(ranks_, Times{clock_.ms(), whole.count()})) {
      for (std::size_t k = 0; k < PhaseClock::phases; ++k)
        slowest.ms[k] = std::max(slowest.ms[k], times.ms[k]);
      slowest.whole = std::max(slowest.whole, times.whole);
    }
    times_.push_back(slowest);
    if (last)
      say(answer, work, box, ranks_.traffic().bytes - before.bytes,
          ranks_.traffic().messages - before.messages);
  }

  void say(const RankAnswer& answer, const RankWork& work, const std::optional<PeriodicBox>& box,
           std::uint64_t bytes, std::uint64_t messages) {
    struct Share {
      std::uint64_t cores, spheres, asked, touching, rounds, bytes, messages;
      PhasePeaks::Kib peak_kib;
    };
    const auto shares = all_gather_value(
        ranks_, Share{usable_cores(), work.spheres, work.across.blocks_asked, work.across.blocks_touching,
                      work.across.rounds, bytes, messages, peaks_.kib()});
    if (ranks_.rank() != 0) return;
    nlohmann::ordered_json line{{"input", input_},
                                {"n", answer.starts.back()},
                                {"variant", search_.variant()},
                                {"ranks", ranks_.size()},
                                {"order", work.in_space ? "space" : "chain"},
                                {"pairs", answer.pair_count},
                                {"repetitions", repetitions_}};
    if (box) line["box"] = written(*box);
    line["whole_ms"] = median([](const Times& t) { return t.whole; });
    for (std::size_t k = 0; k + 1 < PhaseClock::phases; ++k)
      line["phases_ms"][name_of(static_cast<Phase>(k))] = median([k](const Times& t) { return t.ms[k]; });
    for (std::size_t k = 0; k + 1 < PhasePeaks::phases; ++k) {
      const auto& most = std::ranges::max(shares, {}, [k](const Share& s) { return s.peak_kib[k]; });
      line["phases_peak_kib"][name_of(static_cast<Phase>(k))] = most.peak_kib[k];
    }
    for (const Share& s : shares)
      line["of_ranks"].push_back({{"cores", s.cores},
                                  {"spheres", s.spheres},
                                  {"blocks_asked", s.asked},
                                  {"blocks_touching", s.touching},
                                  {"rounds", s.rounds},
                                  {"bytes", s.bytes},
                                  {"messages", s.messages},
                                  {"peak_kib", std::ranges::max(s.peak_kib)}});
    fmt::print("{}\n", json_line(line));
  }

  template <class Field>
  double median(const Field& field) const {
    std::vector<double> values;
    for (const Times& times : times_) values.push_back(field(times));
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
  }

  Communicator& ranks_ = world();
  std::string input_;
  unsigned repetitions_ = 5;
  bool json_ = false;
  SearchOptions search_;
  PhaseClock clock_;
  PhasePeaks peaks_;
  std::vector<Times> times_;
};

const RegisterCommand<BenchCommand> registered("bench",
                                               "Time a search by ranks, phase by phase, as one JSON object",
                                               true);

}  // namespace
}  // namespace catena::ranks
