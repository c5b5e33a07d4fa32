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
        kept_(options.request.want == Request::Want::pairs ? options.request.pair_limit : 0,
              options.pairs_of) {}

  RankAnswer run(Part part) {
    enter(Phase::take_part);
    starts_ = starts_of(ranks_, part);
    enter(Phase::order);
    work_.in_space = wants_space_order(part);
    if (work_.in_space) {
      enter(Phase::repartition);
      part = part_in_space(ranks_, std::move(part), options_.blocks_at_once);
    }
    enter(Phase::build);
    part_.emplace(std::move(part));
    work_.spheres = part_->chain().size();
    work_.blocks = blocks_of(part_->pieces());
    if (!options_.across_only) search_within_part();
    enter(Phase::across);
    if (ranks_.size() > 1) search_across_ranks();
    return answer();
  }

 private:
  void enter(Phase phase) const { options_.entering(phase); }

  bool wants_space_order(const Part& part) {
    if (ranks_.size() == 1 || options_.order == Order::chain) return false;
    if (options_.order == Order::space) return true;
    work_.touching_share = touching_share(ranks_, part);
    return work_.touching_share > most_touching;
  }

  void search_within_part() {
    const Request& request = options_.request;
    const auto variant = StrategyRegistry::instance().make(options_.variant);
    blaming(options_.variant, [&] {
      variant->prepare({.want = asked_within(*part_, request.want, kept_)});
      variant->build(part_->chain());
    });
    enter(Phase::within);
    blaming(options_.variant,
            [&] { count_ = search_within(*part_, *variant, request.want, request.pair_limit, kept_); });
    work_.pairs_within = kept_.found();
  }

  void search_across_ranks() {
    const AcrossOptions options{.stop_at_first = options_.request.want == Request::Want::any,
                                .blocks_at_once = options_.blocks_at_once,
                                .meetings = options_.meetings};
    work_.across = search_across(ranks_, *part_, options, counted_, kept_);
    work_.pairs_across = kept_.found() - work_.pairs_within;
  }

  RankAnswer answer() {
    enter(Phase::answers);
    const std::vector<Piece> pieces = std::move(*part_).release_pieces();
    part_.reset();  // its memory serves the answer
    RankAnswer answer;
    for (const std::uint64_t found : all_gather_value(ranks_, kept_.found())) answer.pair_count += found;
    answer.found = answer.pair_count > 0;
    answer.starts = starts_;
    answer.first = starts_[ranks_.rank()];
    if (options_.request.want == Request::Want::any) {
      answer.pair_count = 0;
    } else {
      answer.count = return_counts(ranks_, starts_, own_counts(pieces), counted_);
      std::vector<std::uint32_t>().swap(count_);
      if (options_.request.want == Request::Want::pairs && answer.pair_count <= options_.request.pair_limit)
        answer.pairs = return_pairs(ranks_, starts_, kept_.take());
    }
    enter(Phase::done);
    return answer;
  }

  std::vector<CountRun> own_counts(const std::vector<Piece>& pieces) const {
    std::vector<CountRun> runs;
    if (count_.empty()) return runs;
    for (const Piece& piece : pieces)
      runs.push_back({piece.first, std::span(count_).subspan(piece.begin, piece.size)});
    return runs;
  }

  Communicator& ranks_;
  const RankOptions& options_;
  RankWork& work_;
  std::vector<SphereId> starts_;  ///< of the parts as they came
  std::optional<HeldPart> part_;
  std::vector<std::uint32_t> count_;  ///< within part_, of its spheres
  std::vector<Counted> counted_;      ///< across ranks
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
