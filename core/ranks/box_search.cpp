#include "catena/core/ranks/box_search.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "catena/core/periodic/periodic.h"
#include "catena/core/ranks/bytes.h"
#include "catena/core/ranks/named_part.h"

namespace catena::ranks {
namespace {

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

/// All pairs of a chain that only rank 0 has, there; all ranks call it.
std::vector<IdPair> pairs_by_all(Communicator& ranks, const Chain* chain, RankOptions options,
                                 RankWork& work) {
  NamedPart part = scatter(ranks, [&](unsigned rank) {
    return NamedPart{even_part_of(*chain, ranks.size(), rank), {}};
  });
  options.request = {.want = Request::Want::pairs, .pair_limit = no_limit};
  const RankAnswer own = search(ranks, std::move(part.part), options, work);
  std::vector<IdPair> all;
  for (const Message& message : ranks.exchange({{0, ByteWriter().put_list(own.pairs).take()}}))
    for (const IdPair& pair : ByteReader(message.bytes).get_list<IdPair>()) all.push_back(pair);
  return all;
}

/// Whether another search by all is to come: rank 0 knows.
bool told_by_first(Communicator& ranks, bool more) {
  return all_gather_value(ranks, std::uint64_t{more}).front() != 0;
}

/// The search by all ranks as a variant of rank 0; the others call serve meanwhile.
class ByAllRanks final : public Variant {
 public:
  ByAllRanks(Communicator& ranks, const RankOptions& options, RankWork& work)
      : ranks_(ranks), options_(options), work_(work) {}

  void build(const Chain&) override {}
  /// All pairs at once, whatever the limit.
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    told_by_first(ranks_, true);
    const SphereRange queries = request.queries.within(chain.size());
    result.pairs.clear();
    for (const auto& [i, j] : pairs_by_all(ranks_, &chain, options_, work_))
      if (queries.contains(static_cast<std::uint32_t>(i)))
        result.pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    result.pair_count = result.pairs.size();
    result.found = result.pair_count > 0;
  }
  Timings timings() const override { return {}; }

  static void serve(Communicator& ranks, const RankOptions& options, RankWork& work) {
    while (told_by_first(ranks, false)) pairs_by_all(ranks, nullptr, options, work);
  }

 private:
  Communicator& ranks_;
  const RankOptions& options_;
  RankWork& work_;
};

Collisions led(Communicator& ranks, const Chain& chain, const PeriodicBox& box, const RankOptions& options,
               RankWork& work) {
  Periodic periodic(std::make_unique<ByAllRanks>(ranks, options, work), box);
  Collisions found;
  periodic.build(chain);
  try {
    periodic.find(chain, options.request, found);
  } catch (const PairLimitExceeded& error) {
    found.pairs.clear();
    found.pair_count = error.found();
  }
  told_by_first(ranks, false);
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
