#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "catena/core/commands/command.h"
#include "catena/ranks/bytes.h"
#include "catena/ranks/lattice_part.h"
#include "catena/ranks/mpi/mpi_launcher.h"
#include "catena/ranks/mpi/rank_options.h"

namespace catena::ranks {
namespace {

/// `mpirun -n K catena closed-form`: a chain that each rank makes its part of, and whose pairs a formula knows, of any size
/// that all ranks hold together.
class ClosedFormCommand final : public Command {
 public:
  void configure(CLI::App& app) override {
    app.add_option("--side", box_.side, "Points along each of three axes; side^3 spheres")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--reach", box_.reach, "Spheres of points so many steps apart touch exactly")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    app.add_flag("--face-centred", box_.face_centred, "The face-centred lattice instead of the cubic one");
    app.add_flag("--rods", box_.rods, "A bundle: each row a strand of its own");
    app.add_flag("--counts-only", counts_only_, "Compare counts, keep no pairs");
    app.add_flag("--json", json_, "One JSON object");
    search_.add_to(app);
  }

  int run() override {
    const Request request{.want = counts_only_ ? Request::Want::counts : Request::Want::pairs};
    const RankOptions options = search_.of(request);
    std::string wrong;
    together(ranks_, [&] {
      const auto start = [&](unsigned rank) { return even_start(box_.spheres(), ranks_.size(), rank); };
      const SphereId begin = start(ranks_.rank()), end = start(ranks_.rank() + 1);
      if (end - begin >= SphereId{1} << 31)
        throw InputError(fmt::format("{} spheres are too many for {} ranks; take more ranks", box_.spheres(), ranks_.size()));
      RankWork work;
      const RankAnswer answer = search(ranks_, lattice_part(box_, begin, end), options, work);
      if (answer.pair_count > request.pair_limit && !counts_only_)
        throw PairLimitExceeded(answer.pair_count, request.pair_limit);
      wrong = lattice_fault(ranks_, box_, answer, !counts_only_);
      const Gathered faults = ranks_.all_gather(ByteWriter().put_all(std::span<const char>(wrong)).take());
      for (const Bytes& fault : *faults)
        if (wrong.empty()) wrong.assign(reinterpret_cast<const char*>(fault.data()), fault.size());
      if (ranks_.rank() == 0) say(answer, work, wrong);
    });
    return wrong.empty() ? 0 : 1;
  }

 private:
  void say(const RankAnswer& answer, const RankWork& work, const std::string& wrong) const {
    const char* const order = work.in_space ? "space" : "chain";
    if (json_) {
      const nlohmann::ordered_json line{{"input", box_.scene()}, {"n", answer.starts.back()}, {"ranks", ranks_.size()},
                                        {"order", order}, {"pairs", answer.pair_count}, {"closed_form", box_.pairs()},
                                        {"ties", box_.ties()}, {"fault", wrong}};
      fmt::print("{}\n", line.dump());
      return;
    }
    fmt::print("{}: {} spheres; closed form {} pairs, {} of them exact ties\n{} ranks, shared out by {}: {} pairs, {}\n",
               box_.scene(), answer.starts.back(), box_.pairs(), box_.ties(), ranks_.size(), order, answer.pair_count,
               wrong.empty() ? "right" : "WRONG: " + wrong);
  }

  Communicator& ranks_ = world();
  bench::LatticeBox box_;
  SearchOptions search_;
  bool counts_only_ = false, json_ = false;
};

const RegisterCommand<ClosedFormCommand> registered(
    "closed-form", "A chain made by parts, whose pairs a formula knows, at any size", true);

}  // namespace
}  // namespace catena::ranks
