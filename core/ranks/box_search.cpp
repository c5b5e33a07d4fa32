#include "catena/core/ranks/box_search.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "catena/core/periodic/periodic.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/named_part.h"

namespace catena::ranks {
namespace {

/// What rank 0 asks of all next.
struct Task {
  enum class Kind : std::uint64_t { none, whether_any, pairs } kind = Kind::none;
  std::uint64_t pair_limit = 0;
  IdRange pairs_of{};
};

Task told_by_first(Communicator& ranks, const Task& task) { return all_gather_value(ranks, task).front(); }

/// What all ranks find in a chain that only rank 0 has; all call it.
RankAnswer search_by_all(Communicator& ranks, const Chain* chain, const Task& task, RankOptions options,
                         RankWork& work) {
  NamedPart part = scatter(ranks, [&](unsigned rank) {
    return NamedPart{even_part_of(*chain, ranks.size(), rank), {}};
  });
  const bool pairs = task.kind == Task::Kind::pairs;
  options.request = {.want = pairs ? Request::Want::pairs : Request::Want::any,
                     .pair_limit = task.pair_limit};
  options.pairs_of = task.pairs_of;
  RankAnswer answer = search(ranks, std::move(part.part), options, work);
  std::vector<Message> own;
  if (!answer.pairs.empty()) own.push_back({0, ByteWriter().put_list(answer.pairs).take()});
  answer.pairs.clear();
  for (Message& message : ranks.exchange(std::move(own))) {
    const auto theirs = ByteReader(message.bytes).get_list<IdPair>();
    answer.pairs.insert(answer.pairs.end(), theirs.begin(), theirs.end());
    Bytes().swap(message.bytes);
  }
  return answer;
}

/// The search by all ranks as a variant of rank 0; the others call serve meanwhile. Counts of spheres, which
/// Periodic does not ask for, are not filled.
class ByAllRanks final : public Variant {
 public:
  ByAllRanks(Communicator& ranks, const RankOptions& options, RankWork& work)
      : ranks_(ranks), options_(options), work_(work) {}

  void build(const Chain&) override {}
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    const bool any = request.want == Request::Want::any;
    Task task{any ? Task::Kind::whether_any : Task::Kind::pairs, request.pair_limit, {}};
    const SphereRange queries = request.queries.within(chain.size());
    if (queries.size() < chain.size()) task.pairs_of = {queries.begin, queries.end};
    told_by_first(ranks_, task);
    const RankAnswer answer = search_by_all(ranks_, &chain, task, options_, work_);
    result.pairs.clear();
    result.found = answer.found;
    result.pair_count = answer.pair_count;
    if (!any && answer.pair_count > request.pair_limit)
      throw PairLimitExceeded(answer.pair_count, request.pair_limit);
    for (const auto& [i, j] : answer.pairs)
      result.pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
  }
  Timings timings() const override { return {}; }

  static void serve(Communicator& ranks, const RankOptions& options, RankWork& work) {
    for (Task task; (task = told_by_first(ranks, {})).kind != Task::Kind::none;)
      search_by_all(ranks, nullptr, task, options, work);
  }

 private:
  Communicator& ranks_;
  const RankOptions& options_;
  RankWork& work_;
};

Collisions led(Communicator& ranks, const Chain& chain, const PeriodicBox& box, const RankOptions& options,
               RankWork& work) {
  Periodic periodic(std::make_unique<ByAllRanks>(ranks, options, work), box);
  periodic.prepare(options.request);
  Collisions found;
  periodic.build(chain);
  try {
    periodic.find(chain, options.request, found);
  } catch (const PairLimitExceeded& error) {
    found.pairs.clear();
    found.pair_count = error.found();
  }
  told_by_first(ranks, {});
  return found;
}

/// What rank 0 says to each.
std::vector<Message> shares_of(Communicator& ranks, const Chain& chain, Collisions found) {
  std::ranges::sort(found.pairs);
  std::vector<Message> shares;
  auto pair = found.pairs.begin();
  for (unsigned rank = 0; rank < ranks.size(); ++rank) {
    const SphereId first = even_start(chain.size(), ranks.size(), rank),
                   end = even_start(chain.size(), ranks.size(), rank + 1);
    std::vector<IdPair> pairs;
    for (; pair != found.pairs.end() && pair->i < end; ++pair) pairs.push_back({pair->i, pair->j});
    std::vector<std::uint64_t> count;
    if (!found.count.empty())
      count.assign(found.count.begin() + static_cast<std::ptrdiff_t>(first),
                   found.count.begin() + static_cast<std::ptrdiff_t>(end));
    ByteWriter out;
    out.put(SphereId{chain.size()}).put(std::uint64_t{found.found}).put(found.pair_count);
    shares.push_back({rank, out.put_list(count).put_list(pairs).take()});
  }
  return shares;
}

RankAnswer own_of(const Communicator& ranks, const Message& share) {
  ByteReader in(share.bytes);
  RankAnswer answer;
  const auto n = in.get<SphereId>();
  for (unsigned rank = 0; rank <= ranks.size(); ++rank)
    answer.starts.push_back(even_start(n, ranks.size(), rank));
  answer.first = answer.starts[ranks.rank()];
  answer.found = in.get<std::uint64_t>() != 0;
  answer.pair_count = in.get<std::uint64_t>();
  answer.count = in.get_list<std::uint64_t>();
  answer.pairs = in.get_list<IdPair>();
  return answer;
}

}  // namespace

RankAnswer search_in_box(Communicator& ranks, const std::optional<Chain>& chain, const PeriodicBox& box,
                         const RankOptions& options, RankWork& work) {
  RankAnswer answer;
  std::vector<Message> shares;
  if (ranks.rank() == 0)
    shares = shares_of(ranks, *chain, led(ranks, *chain, box, options, work));
  else
    ByAllRanks::serve(ranks, options, work);
  for (const Message& share : ranks.exchange(std::move(shares))) answer = own_of(ranks, share);
  return answer;
}

}  // namespace catena::ranks
