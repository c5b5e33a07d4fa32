#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/counted.h"
#include "catena/core/ranks/mpi/mpi_launcher.h"
#include "catena/core/ranks/mpi/rank_options.h"
#include "catena/core/ranks/mpi/shared_input.h"
#include "catena/core/ranks/rank_input.h"
#include "catena/reference/ranks/verify_answer.h"

namespace catena::ranks {
namespace {

/// `mpirun -n K catena verify INPUT...`: the answer of the ranks against the exact reference, which rank 0
/// runs alone.
class VerifyCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", inputs_, "Scenes and files that one process can hold").required();
    search_.add_to(app);
    search_.add_input_to(app);
    app.add_flag("--json", json_, "One JSON object a line for each input and order");
  }

  int run() override {
    bool right = true;
    together(ranks_, [&] {
      for (const std::string& input : inputs_)
        for (const Order order : {Order::chain, Order::space}) right = verify(input, order) && right;
    });
    return right ? 0 : 1;
  }

 private:
  bool verify(const std::string& name, Order order) {
    const RankInput input(ranks_, name, search_.input(), open_shared);
    RankOptions options = search_.of({});
    options.order = order;
    std::optional<Chain> whole = input.whole(0);
    RankWork work;
    const std::optional<PeriodicBox> box = input.box(0);
    const RankAnswer answer = search_frame(ranks_, input, 0, box, input.part(0).part, options, work);
    if (ranks_.rank() == 0 && !whole) whole = open_input(name, search_.input()).animation->frame(0);
    const RankComparison wrong = compare_with_reference(ranks_, whole, answer, box ? &*box : nullptr);
    if (ranks_.rank() == 0) say(name, order, answer, wrong);
    return wrong.right();
  }

  void say(const std::string& name, Order order, const RankAnswer& answer,
           const RankComparison& wrong) const {
    const char* const shared = order == Order::chain ? "chain" : "space";
    if (json_) {
      const nlohmann::ordered_json line{{"input", name},
                                        {"n", answer.starts.back()},
                                        {"ranks", ranks_.size()},
                                        {"order", shared},
                                        {"pairs", answer.pair_count},
                                        {"verdict", wrong.right() ? "exact" : "wrong"},
                                        {"missing", wrong.missing},
                                        {"invented", wrong.invented},
                                        {"repeated", wrong.repeated},
                                        {"wrong_counts", wrong.wrong_counts}};
      fmt::print("{}\n", json_line(line));
      return;
    }
    const std::string verdict =
        wrong.right() ? "exact"
                      : fmt::format("WRONG: {} missing, {} invented, {} repeated, {} counts wrong",
                                    wrong.missing, wrong.invented, wrong.repeated, wrong.wrong_counts);
    fmt::print("{}: {}, {}; {}, shared out by {}: {}\n", name, counted(answer.starts.back(), "sphere"),
               counted(answer.pair_count, "pair"), counted(ranks_.size(), "rank"), shared, verdict);
  }

  Communicator& ranks_ = world();
  std::vector<std::string> inputs_;
  SearchOptions search_;
  bool json_ = false;
};

const RegisterCommand<VerifyCommand> registered("verify",
                                                "Compare the answer of the ranks with the exact reference",
                                                true);

}  // namespace
}  // namespace catena::ranks
