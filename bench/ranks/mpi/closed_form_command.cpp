#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catena/bench/closed_form/lattice_options.h"
#include "catena/bench/ranks/lattice_part.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/counted.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/mpi/mpi_launcher.h"
#include "catena/core/ranks/mpi/phase_peaks.h"
#include "catena/core/ranks/mpi/rank_options.h"

namespace catena::ranks {
namespace {

/// `mpirun -n K catena closed-form`: a chain that each rank makes its part of, and whose pairs a formula
/// knows, of any size that all ranks hold together.
class ClosedFormCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    lattice_.add_to(app, 100000);
    search_.add_to(app);
  }

  int run() override {
    const Request request = lattice_.request();
    const bench::LatticeBox& box = lattice_.box;
    RankOptions options = search_.of(request);
    PhasePeaks peaks;
    options.entering = [&](Phase phase) { peaks.enter(phase); };
    std::string wrong;
    together(ranks_, [&] {
      const auto start = [&](unsigned rank) { return even_start(box.spheres(), ranks_.size(), rank); };
      const SphereId begin = start(ranks_.rank()), end = start(ranks_.rank() + 1);
      if (end - begin >= SphereId{1} << 31)
        throw InputError(fmt::format("{} spheres are too many for {} ranks; take more ranks", box.spheres(),
                                     ranks_.size()));
      RankWork work;
      const RankAnswer answer = search(ranks_, lattice_part(box, begin, end), options, work);
      if (answer.pair_count > request.pair_limit && !lattice_.counts_only)
        throw CapacityError(fmt::format(
            "{} (--counts-only)", PairLimitExceeded(answer.pair_count, request.pair_limit).what()));
      wrong = lattice_fault(ranks_, box, answer, !lattice_.counts_only);
      const Gathered faults = ranks_.all_gather(ByteWriter().put_all(std::span<const char>(wrong)).take());
      for (const Bytes& fault : *faults)
        if (wrong.empty()) wrong.assign(reinterpret_cast<const char*>(fault.data()), fault.size());
      PhasePeaks::Kib most{};
      for (const PhasePeaks::Kib& kib : all_gather_value(ranks_, peaks.kib()))
        for (std::size_t k = 0; k < kib.size(); ++k) most[k] = std::max(most[k], kib[k]);
      if (ranks_.rank() == 0) say(answer, work, wrong, most);
    });
    return wrong.empty() ? 0 : 1;
  }

 private:
  /// `most`: of the rank that held the most, in each phase.
  void say(const RankAnswer& answer, const RankWork& work, const std::string& wrong,
           const PhasePeaks::Kib& most) const {
    const bench::LatticeBox& box = lattice_.box;
    const char* const order = work.in_space ? "space" : "chain";
    if (lattice_.json) {
      nlohmann::ordered_json line{{"input", box.scene()},       {"n", answer.starts.back()},
                                  {"ranks", ranks_.size()},     {"order", order},
                                  {"pairs", answer.pair_count}, {"closed_form", box.pairs()},
                                  {"ties", box.ties()},         {"fault", wrong}};
      for (std::size_t k = 0; k + 1 < PhasePeaks::phases; ++k)
        line["phases_peak_kib"][name_of(static_cast<Phase>(k))] = most[k];
      fmt::print("{}\n", json_line(line));
      return;
    }
    fmt::print("{}: {}; closed form {}, {} of them exact ties\n{}, shared out by {}: {}, {}\n", box.scene(),
               counted(answer.starts.back(), "sphere"), counted(box.pairs(), "pair"), box.ties(),
               counted(ranks_.size(), "rank"), order, counted(answer.pair_count, "pair"),
               wrong.empty() ? "right" : "WRONG: " + wrong);
  }

  Communicator& ranks_ = world();
  bench::LatticeOptions lattice_;
  SearchOptions search_;
};

const RegisterCommand<ClosedFormCommand> registered(
    "closed-form", "A chain made by parts, whose pairs a formula knows, at any size", true);

}  // namespace
}  // namespace catena::ranks
