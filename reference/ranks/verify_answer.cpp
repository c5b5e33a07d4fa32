#include "catena/reference/ranks/verify_answer.h"

#include <algorithm>
#include <iterator>

#include "catena/core/ranks/bytes.h"
#include "catena/reference/find_in_box.h"

namespace catena::ranks {
namespace {

/// What a rank ought to have.
struct Expected {
  std::uint64_t pair_count = 0;
  std::vector<std::uint32_t> count;
  std::vector<IdPair> pairs;
};

std::vector<Message> told(const reference::Answer& exact, const std::vector<SphereId>& starts) {
  std::vector<Message> out;
  auto pair = exact.pairs.begin();
  for (unsigned rank = 0; rank + 1 < starts.size(); ++rank) {
    std::vector<IdPair> pairs;
    for (; pair != exact.pairs.end() && pair->i < starts[rank + 1]; ++pair)
      pairs.push_back({pair->i, pair->j});
    const std::vector<std::uint32_t> count(
        exact.count.begin() + static_cast<std::ptrdiff_t>(starts[rank]),
        exact.count.begin() + static_cast<std::ptrdiff_t>(starts[rank + 1]));
    out.push_back({rank, ByteWriter().put(exact.pair_count).put_list(count).put_list(pairs).take()});
  }
  return out;
}

RankComparison compare(const Expected& exact, const RankAnswer& answer) {
  RankComparison wrong;
  wrong.wrong_total = answer.pair_count != exact.pair_count || answer.found != (exact.pair_count > 0);
  std::vector<IdPair> found = answer.pairs, other;
  std::ranges::sort(found);
  const auto again = std::unique(found.begin(), found.end());
  wrong.repeated = static_cast<std::uint64_t>(found.end() - again);
  found.erase(again, found.end());
  std::ranges::set_difference(exact.pairs, found, std::back_inserter(other));
  wrong.missing = other.size();
  other.clear();
  std::ranges::set_difference(found, exact.pairs, std::back_inserter(other));
  wrong.invented = other.size();
  for (std::size_t k = 0; k < exact.count.size(); ++k)
    wrong.wrong_counts += k >= answer.count.size() || answer.count[k] != exact.count[k];
  return wrong;
}

}  // namespace

RankComparison compare_with_reference(Communicator& ranks, const std::optional<Chain>& chain,
                                      const RankAnswer& answer, const PeriodicBox* box) {
  std::vector<Message> out;
  if (chain) out = told(reference::find_in(*chain, box), answer.starts);
  Expected exact;
  for (const Message& message : ranks.exchange(std::move(out))) {
    ByteReader in(message.bytes);
    exact.pair_count = in.get<std::uint64_t>();
    exact.count = in.get_list<std::uint32_t>();
    exact.pairs = in.get_list<IdPair>();
  }
  RankComparison all;
  for (const RankComparison& one : all_gather_value(ranks, compare(exact, answer))) {
    all.missing += one.missing, all.invented += one.invented;
    all.repeated += one.repeated, all.wrong_counts += one.wrong_counts;
    all.wrong_total = all.wrong_total || one.wrong_total;
  }
  return all;
}

}  // namespace catena::ranks
