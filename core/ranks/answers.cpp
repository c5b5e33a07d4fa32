#include "catena/core/ranks/answers.h"

#include <algorithm>

#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

/// Records to the ranks on which the spheres began that `sphere` names in them.
template <class Record>
std::vector<std::vector<Record>> returned(Communicator& ranks, std::span<const SphereId> starts,
                                          std::vector<Record> records, SphereId Record::*sphere) {
  std::ranges::sort(records, {}, sphere);
  std::vector<Message> out;
  for (auto at = records.begin(); at != records.end();) {
    const auto next = std::ranges::upper_bound(starts, (*at).*sphere);
    const auto end = std::ranges::lower_bound(at, records.end(), *next, {}, sphere);
    const auto rank = static_cast<unsigned>(next - starts.begin() - 1);
    out.push_back({rank, ByteWriter().put_list(std::vector<Record>(at, end)).take()});
    at = end;
  }
  std::vector<Record>().swap(records);
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
  std::vector<IdPair> own;
  for (const auto& list : returned(ranks, starts, std::move(pairs), &IdPair::i))
    own.insert(own.end(), list.begin(), list.end());
  std::ranges::sort(own);
  return own;
}

}  // namespace catena::ranks
