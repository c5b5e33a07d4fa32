#include "catena/core/ranks/answers.h"

#include <algorithm>
#include <numeric>

#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

/// Records to the ranks on which the spheres began that `sphere` names in them. O(records log ranks).
template <class Record>
std::vector<std::vector<Record>> returned(Communicator& ranks, std::span<const SphereId> starts,
                                          std::vector<Record> records, SphereId Record::*sphere) {
  const auto owner = [&](const Record& record) {
    return static_cast<std::size_t>(std::ranges::upper_bound(starts, record.*sphere) - starts.begin()) - 1;
  };
  std::vector<std::vector<Record>> shares(ranks.size());
  {
    std::vector<std::size_t> sizes(ranks.size(), 0);
    for (const Record& record : records) ++sizes[owner(record)];
    for (unsigned rank = 0; rank < ranks.size(); ++rank) shares[rank].reserve(sizes[rank]);
  }
  for (const Record& record : records) shares[owner(record)].push_back(record);
  std::vector<Record>().swap(records);
  std::vector<Message> out;
  for (unsigned rank = 0; rank < ranks.size(); ++rank) {
    if (!shares[rank].empty()) out.push_back({rank, ByteWriter().put_list(shares[rank]).take()});
    std::vector<Record>().swap(shares[rank]);
  }
  std::vector<std::vector<Record>> lists;
  for (Message& message : ranks.exchange(std::move(out))) {
    lists.push_back(ByteReader(message.bytes).get_list<Record>());
    Bytes().swap(message.bytes);
  }
  return lists;
}

}  // namespace

std::vector<std::uint64_t> return_counts(Communicator& ranks, std::span<const SphereId> starts,
                                         std::vector<Counted> counted) {
  const SphereId first = starts[ranks.rank()];
  std::vector<std::uint64_t> count(starts[ranks.rank() + 1] - first);
  for (const auto& list : returned(ranks, starts, std::move(counted), &Counted::sphere))
    for (const auto& [sphere, collisions] : list) count[sphere - first] += collisions;
  return count;
}

std::vector<IdPair> return_pairs(Communicator& ranks, std::span<const SphereId> starts,
                                 std::vector<IdPair> pairs) {
  const auto lists = returned(ranks, starts, std::move(pairs), &IdPair::i);
  // A counting sort by the first sphere, which is one of this rank's; a sphere has few pairs.
  const SphereId first = starts[ranks.rank()];
  std::vector<std::size_t> begin(starts[ranks.rank() + 1] - first + 1, 0);  // of each sphere's pairs
  for (const auto& list : lists)
    for (const IdPair& pair : list) ++begin[pair.i - first + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<IdPair> own(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const auto& list : lists)
    for (const IdPair& pair : list) own[next[pair.i - first]++] = pair;
  for (std::size_t i = 0; i + 1 < begin.size(); ++i)
    std::sort(own.begin() + begin[i], own.begin() + begin[i + 1]);
  return own;
}

}  // namespace catena::ranks
