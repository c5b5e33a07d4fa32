#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/output_names.h"
#include "catena/core/counted.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/one_line.h"
#include "catena/core/ranks/answer_text.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/mpi/mpi_launcher.h"
#include "catena/core/ranks/mpi/rank_fault.h"
#include "catena/core/ranks/mpi/rank_options.h"
#include "catena/core/ranks/mpi/shared_input.h"
#include "catena/core/ranks/mpi/shared_output.h"
#include "catena/core/ranks/phase_clock.h"
#include "catena/core/ranks/rank_input.h"

namespace catena::ranks {
namespace {

/// `mpirun -n K catena detect INPUT`: the answer of catena detect, found by K processes that hold a part
/// each.
class DetectCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", input_, "A scene (path1:n=150000,frame=3) or a file (neuron.swc)").required();
    search_.add_to(app);
    search_.add_input_to(app);
    frame_.add_to(app);
    app.add_option("--pairs", tables_.pairs,
                   "Write the colliding pairs to this file: CSV, or JSON lines (.jsonl)");
    app.add_option("--counts", tables_.counts, "Write the collisions of each sphere to this file, likewise");
    app.add_flag("--depth", tables_.depth, "--pairs has a column with the depth of the overlap");
    app.add_flag("--margin", tables_.margin, "--pairs has a column with the margin, |q - t| / t");
    app.add_option("--pair-limit", request_.pair_limit, "Most pairs of all ranks to keep; more is an error")
        .whole_number()
        .capture_default_str();
    want_.add_to(app);
    app.add_flag("--json", json_, "One JSON object a line for each frame");
  }

  int run() override {
    request_.want = want_.want();
    check_answer_options(request_, tables_);
    leave_out_unread_pairs(request_, tables_);
    require_apart(input_, search_.input().reading, {tables_.pairs, tables_.counts});
    RankOptions options = search_.of(request_);
    options.entering = [this](Phase phase) {
      clock_.enter(phase);
      meet_fault(name_of(phase), ranks_.rank());
    };
    std::optional<PairLimitExceeded> too_many;
    together(ranks_, [&] { search_frames(options, too_many); });
    if (too_many) throw *too_many;
    return 0;
  }

 private:
  void search_frames(const RankOptions& options, std::optional<PairLimitExceeded>& too_many) {
    meet_fault("read", ranks_.rank());
    const RankInput input(ranks_, input_, search_.input(), open_shared);
    const auto [first, last] = input.frames(frame_);
    std::optional<SharedOutput> pairs, counts;
    if (!tables_.pairs.empty()) open(pairs, tables_.pairs, tables_.pair_columns());
    if (!tables_.counts.empty()) open(counts, tables_.counts, AnswerTables::count_columns());
    for (std::uint32_t f = first; f < last; ++f) {
      NamedPart part = input.part(f);
      const NamedPart none;
      const Directory directory(pairs || counts ? part : none, tables_.depth || tables_.margin);
      clock_ = {};
      RankWork work;
      const std::uint64_t sent_before = ranks_.traffic().bytes;
      const std::optional<PeriodicBox> box = input.box(f);
      const RankAnswer answer = search_frame(ranks_, input, f, box, std::move(part.part), options, work);
      if (request_.want == Request::Want::pairs && answer.pair_count > request_.pair_limit) {
        too_many.emplace(answer.pair_count, request_.pair_limit, input.name_of(f));
        return;
      }
      const std::uint32_t frame = written_frame(input_) + f;
      say(frame, answer, work, ranks_.traffic().bytes - sent_before);
      meet_fault("write", ranks_.rank());
      if (pairs) pairs->append(pair_rows(ranks_, tables_, frame, directory, answer, box ? &*box : nullptr));
      if (counts) counts->append(count_rows(tables_, frame, directory, answer));
    }
    if (pairs) pairs->close();
    if (counts) counts->close();
  }

  void open(std::optional<SharedOutput>& file, const std::string& name,
            const std::vector<std::string>& columns) {
    file.emplace(ranks_, name);
    file->append(ranks_.rank() == 0 ? RowText(name, columns).heading() : "");
  }

  /// What rank 0 prints; the others have their share in it.
  void say(std::uint32_t frame, const RankAnswer& answer, const RankWork& work, std::uint64_t sent) const {
    struct Share {
      std::uint64_t most, spheres, blocks_asked, bytes;
      PhaseClock::Milliseconds ms;
    } share{answer.count.empty() ? 0 : *std::ranges::max_element(answer.count), work.spheres,
            work.across.blocks_asked, sent, clock_.ms()};
    const auto shares = all_gather_value(ranks_, share);
    if (ranks_.rank() != 0) return;
    const auto greatest = [&](auto Share::*field) {
      return (*std::ranges::max_element(shares, {}, field)).*field;
    };
    const auto slowest = [&](Phase phase) {
      double most = 0;
      for (const Share& s : shares) most = std::max(most, s.ms[static_cast<std::size_t>(phase)]);
      return most;
    };
    const SphereId n = answer.starts.back();
    if (json_) {
      nlohmann::ordered_json line{{"input", input_},
                                  {"frame", frame},
                                  {"n", n},
                                  {"variant", search_.variant()},
                                  {"ranks", ranks_.size()},
                                  {"order", work.in_space ? "space" : "chain"},
                                  {"collides", answer.found}};
      if (request_.want != Request::Want::any)
        line["pairs"] = answer.pair_count, line["max_count"] = greatest(&Share::most);
      line["most_spheres"] = greatest(&Share::spheres);
      line["most_blocks_asked"] = greatest(&Share::blocks_asked);
      line["most_bytes_sent"] = greatest(&Share::bytes);
      for (std::size_t k = 0; k + 1 < PhaseClock::phases; ++k)
        line["phases_ms"][name_of(static_cast<Phase>(k))] = slowest(static_cast<Phase>(k));
      fmt::print("{}\n", json_line(line));
      return;
    }
    const std::string what = request_.want == Request::Want::any
                                 ? (answer.found ? "collides" : "does not collide")
                                 : fmt::format("{}, at most {} a sphere", counted(answer.pair_count, "pair"),
                                               greatest(&Share::most));
    fmt::print(
        "{} frame {}: {}, {}; {} {}, {}: share {:.3f} ms, build {:.3f} ms, find {:.3f} ms, exchange {:.3f} "
        "ms\n",
        one_line(input_), frame, counted(n, "sphere"), what, counted(ranks_.size(), "rank"),
        work.in_space ? "by space" : "in chain order", search_.variant(),
        slowest(Phase::take_part) + slowest(Phase::order) + slowest(Phase::repartition),
        slowest(Phase::build), slowest(Phase::within), slowest(Phase::across) + slowest(Phase::answers));
  }

  Communicator& ranks_ = world();
  std::string input_;
  SearchOptions search_;
  AnswerTables tables_;
  FrameOption frame_;
  WantOptions want_;
  Request request_;
  PhaseClock clock_;
  bool json_ = false;
};

const RegisterCommand<DetectCommand> registered(
    "detect", "Find the self-collisions of a scene or file, each rank a part of it", true);

}  // namespace
}  // namespace catena::ranks
