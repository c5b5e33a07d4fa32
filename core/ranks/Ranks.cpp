#include <limits>
#include <stdexcept>
#include <vector>

#include "catena/core/ranks/rank_search.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/core/strategy/register.h"

namespace catena::ranks {
namespace {

/// Ranks: what `mpirun -n K catena detect` does, on K ranks that are threads of this process. All is
/// searched, whatever is asked for: build keeps nothing but the number of spheres.
template <class Arithmetic>
class Ranks final : public Variant {
 public:
  explicit Ranks(const Parameters& parameters)
      : ranks_(static_cast<unsigned>(parameters.unsigned_integer("ranks", 1, 4096))),
        blocks_at_once_(
            static_cast<std::uint32_t>(parameters.unsigned_integer("blocks_at_once", 0, 1u << 30))),
        meetings_(static_cast<std::uint32_t>(parameters.unsigned_integer("meetings", 0, 1u << 30))),
        order_(parts::order_named(parameters.choice("order", parts::order_names()))),
        uneven_(parameters.choice("parts", {"even", "uneven"}) == "uneven") {}

  void build(const Chain& chain) override { spheres_ = chain.size(), built_ = true; }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (!built_ || chain.size() != spheres_) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    const SphereRange queries = request.queries.within(spheres_);
    RankOptions options{.variant = "auto",
                        .order = order_,
                        .request = request,
                        .blocks_at_once = blocks_at_once_,
                        .meetings = meetings_};
    options.request.queries = {};
    if (queries != SphereRange{0, spheres_})  // parted from all pairs
      options.request.want = Request::Want::pairs,
      options.request.pair_limit = std::numeric_limits<std::uint64_t>::max();
    std::vector<RankAnswer> answers(ranks_);
    run_in_threads(ranks_, [&](Communicator& ranks) {
      const unsigned rank = ranks.rank();
      RankWork work;
      answers[rank] = search(ranks, part_of(chain, start(rank), start(rank + 1)), options, work);
    });
    gather(answers, queries, result);
    if (queries == SphereRange{0, spheres_})
      result.found = answers[0].found, result.pair_count = answers[0].pair_count;
    leave_out_unasked(request, result);
    timings_.find_ms = watch.ms();
  }

  Timings timings() const override { return timings_; }

 private:
  /// Uneven parts grow with the square of the rank, and every third is empty.
  std::uint32_t start(unsigned rank) const {
    if (!uneven_) return static_cast<std::uint32_t>(even_start(spheres_, ranks_, rank));
    if (rank < ranks_ && rank % 3 == 2) rank -= 1;
    return static_cast<std::uint32_t>(std::uint64_t{spheres_} * rank * rank /
                                      (std::uint64_t{ranks_} * ranks_));
  }

  void gather(const std::vector<RankAnswer>& answers, const SphereRange& queries, Collisions& result) const {
    result.pairs.clear();
    result.count.assign(spheres_, 0);
    for (const RankAnswer& answer : answers) {
      for (std::size_t k = 0; k < answer.count.size(); ++k)
        if (const auto i = static_cast<std::uint32_t>(answer.first + k); queries.contains(i))
          result.count[i] = static_cast<std::uint32_t>(answer.count[k]);
      for (const auto& [i, j] : answer.pairs)
        if (queries.contains(static_cast<std::uint32_t>(i)))
          result.pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    }
    result.pair_count = result.pairs.size();
    result.found = result.pair_count > 0;
  }

  static void leave_out_unasked(const Request& request, Collisions& result) {
    if (request.want != Request::Want::pairs) result.pairs.clear();
    if (request.want == Request::Want::any) result.count.clear(), result.pair_count = 0;
    if (request.want != Request::Want::pairs || result.pair_count <= request.pair_limit) return;
    result.pairs.clear();
    throw PairLimitExceeded(result.pair_count, request.pair_limit);
  }

  const unsigned ranks_;
  const std::uint32_t blocks_at_once_, meetings_;
  const Order order_;
  const bool uneven_;
  std::uint32_t spheres_ = 0;
  bool built_ = false;
  Timings timings_;
};

/// Hidden from the lists, as its times are those of ranks that share this machine's cores.
struct RegisterRanks {
  RegisterRanks() {
    StrategyRegistry::instance().add_variant(
        {.name = "Ranks",
         .summary = "parts of the chain on ranks, which are threads here, as mpirun has them in processes",
         .parameters =
             {{"ranks", "3", "ranks that share the chain"},
              {"order", "measured", "spheres are shared out in chain order, by space, or as measured"},
              {"parts", "even", "even or uneven: every third is empty"},
              {"blocks_at_once", "0", "blocks that a rank sends in a round; 0: a quarter of its own"},
              {"meetings", "32",
               "blocks are compared one by one up to so many times their number, then searched for"}}},
        arithmetic_info<Robust>(), make_strategy<Ranks<Robust>, Variant>, true);
  }
};
const RegisterRanks registered;

}  // namespace
}  // namespace catena::ranks
