#include "catena/core/ranks/rank_search.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "catena/core/default_floats.h"
#include "catena/core/ranks/answers.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/space_order.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"

namespace catena::ranks {
namespace {

/// Moving every block once costs less than comparing so many of them with those of others.
constexpr double most_touching = 0.125;

std::vector<SphereId> starts_of(Communicator& ranks, const Part& part) {
  std::vector<SphereId> starts{0};
  for (const std::uint64_t spheres : all_gather_value(ranks, std::uint64_t{part.spheres.size()}))
    starts.push_back(starts.back() + spheres);
  return starts;
}

class RankSearch {
 public:
  RankSearch(Communicator& ranks, const RankOptions& options, RankWork& work)
      : ranks_(ranks),
        options_(options),
        work_(work),
        kept_(options.request.want == Request::Want::pairs ? options.request.pair_limit : 0) {}

  RankAnswer run(Part part) {
    enter(Phase::take_part);
    starts_ = starts_of(ranks_, part);
    hold(std::move(part));
    Tops tops = Tops::of_all(ranks_, *part_);
    enter(Phase::order);
    if (wants_space_order(tops)) {
      enter(Phase::repartition);
      hold(part_in_space(ranks_, *part_));
      work_.in_space = true;
      tops = Tops::of_all(ranks_, *part_);
    }
    work_.spheres = part_->chain().size();
    work_.blocks = part_->blocks().size();
    count_.resize(part_->chain().size());
    if (!options_.across_only) search_within_part();
    search_across_ranks(tops);
    return answer();
  }

 private:
  void enter(Phase phase) const { options_.entering(phase); }

  void hold(Part part) {
    part_.emplace(std::move(part));
    if (ranks_.size() > 1) part_->cut_blocks();
  }

  bool wants_space_order(const Tops& tops) {
    if (ranks_.size() == 1 || options_.order == Order::chain) return false;
    if (options_.order == Order::space) return true;
    work_.touching_share = touching_share(ranks_, *part_, tops);
    return work_.touching_share > most_touching;
  }

  void search_within_part() {
    const Request& request = options_.request;
    enter(Phase::build);
    const auto variant = StrategyRegistry::instance().make(options_.variant);
    blaming(options_.variant, [&] {
      variant->prepare({.want = asked_within(*part_, request.want)});
      variant->build(part_->chain());
    });
    enter(Phase::within);
    blaming(options_.variant,
            [&] { search_within(*part_, *variant, request.want, request.pair_limit, count_, kept_); });
    work_.pairs_within = kept_.found();
  }

  void search_across_ranks(const Tops& tops) {
    enter(Phase::across);
    const AcrossOptions options{.stop_at_first = options_.request.want == Request::Want::any,
                                .blocks_at_once = options_.blocks_at_once};
    work_.across = search_across(ranks_, *part_, tops, options, count_, far_, kept_);
    work_.pairs_across = kept_.found() - work_.pairs_within;
  }

  RankAnswer answer() {
    enter(Phase::answers);
    RankAnswer answer;
    for (const std::uint64_t found : all_gather_value(ranks_, kept_.found())) answer.pair_count += found;
    answer.found = answer.pair_count > 0;
    answer.starts = starts_;
    answer.first = starts_[ranks_.rank()];
    if (options_.request.want == Request::Want::any) {
      answer.pair_count = 0;
    } else {
      add_own_counts();
      answer.count = return_counts(ranks_, starts_, std::move(far_));
      if (options_.request.want == Request::Want::pairs && answer.pair_count <= options_.request.pair_limit)
        answer.pairs = return_pairs(ranks_, starts_, kept_.take());
    }
    enter(Phase::done);
    return answer;
  }

  void add_own_counts() {
    for (const Piece& piece : part_->pieces())
      for (std::uint32_t k = 0; k < piece.size; ++k)
        if (const std::uint64_t collisions = count_[piece.begin + k]; collisions > 0)
          far_.push_back({piece.first + k, collisions});
    std::vector<std::uint64_t>().swap(count_);
  }

  Communicator& ranks_;
  const RankOptions& options_;
  RankWork& work_;
  std::vector<SphereId> starts_;  ///< of the parts as they came
  std::optional<HeldPart> part_;
  std::vector<std::uint64_t> count_;  ///< of the spheres of part_
  std::vector<Counted> far_;
  KeptPairs kept_;
};

}  // namespace

std::string_view name_of(Phase phase) {
  constexpr std::array<std::string_view, 8> names{"take_part", "order",  "repartition", "build",
                                                  "within",    "across", "answers",     "done"};
  return names[static_cast<std::size_t>(phase)];
}

RankAnswer search(Communicator& ranks, Part part, const RankOptions& options, RankWork& work) {
  const DefaultFloats floats;
  RankAnswer answer;
  together(ranks, [&] { answer = RankSearch(ranks, options, work).run(std::move(part)); });
  return answer;
}

}  // namespace catena::ranks
