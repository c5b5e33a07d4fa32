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
  // Parted by the first sphere, which is one of this rank's, in no more parts than there are pairs: each has
  // a few.
  const SphereId first = starts[ranks.rank()], spheres = starts[ranks.rank() + 1] - first;
  std::size_t found = 0;
  for (const auto& list : lists) found += list.size();
  int shift = 0;
  while (spheres >> shift > found) ++shift;
  std::vector<std::size_t> end((spheres >> shift) + 2, 0);  // of each part, in the end
  for (const auto& list : lists)
    for (const IdPair& pair : list) ++end[((pair.i - first) >> shift) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<IdPair> own(found);
  for (const auto& list : lists)
    for (const IdPair& pair : list) own[end[(pair.i - first) >> shift]++] = pair;
  std::size_t begin = 0;
  for (const std::size_t to : end) {
    std::sort(own.begin() + static_cast<std::ptrdiff_t>(begin),
              own.begin() + static_cast<std::ptrdiff_t>(to));
    begin = to;
  }
  return own;
}

}  // namespace catena::ranks
