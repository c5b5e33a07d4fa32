#include "catena/core/ranks/answers.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "catena/core/executor/large_vector.h"
#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

std::size_t owner_of(std::span<const SphereId> starts, SphereId sphere) {
  return static_cast<std::size_t>(std::ranges::upper_bound(starts, sphere) - starts.begin()) - 1;
}

/// What a rank is told of counts: runs in a row, then single spheres.
struct CountShare {
  struct Header {
    SphereId first;
    std::uint64_t size;
  };
  std::vector<Header> runs;
  std::vector<std::span<const std::uint32_t>> count;
  std::vector<Counted> more;

  bool empty() const { return runs.empty() && more.empty(); }
  Bytes packed() const {
    ByteWriter out;
    std::uint64_t spheres = 0;
    for (const Header& run : runs) spheres += run.size;
    out.reserve(3 * sizeof spheres + runs.size() * sizeof(Header) + spheres * sizeof(std::uint32_t) +
                more.size() * sizeof(Counted));
    out.put_list(runs);
    for (const auto& of_run : count) out.put_all(of_run);
    return out.put_list(more).take();
  }
};

/// A run that goes on past a rank's spheres becomes several.
void share_out(std::vector<CountShare>& shares, std::span<const SphereId> starts, CountRun run) {
  while (!run.count.empty()) {
    const std::size_t owner = owner_of(starts, run.first);
    const auto size =
        static_cast<std::size_t>(std::min<SphereId>(run.count.size(), starts[owner + 1] - run.first));
    shares[owner].runs.push_back({run.first, size});
    shares[owner].count.push_back(run.count.first(size));
    run = {run.first + size, run.count.subspan(size)};
  }
}

/// Adds what a rank says to itself.
void add(const CountShare& share, SphereId first, std::vector<std::uint64_t>& count) {
  for (std::size_t k = 0; k < share.runs.size(); ++k) {
    std::uint64_t* to = count.data() + (share.runs[k].first - first);
    for (const std::uint32_t collisions : share.count[k]) *to++ += collisions;
  }
  for (const auto& [sphere, collisions] : share.more) count[sphere - first] += collisions;
}

/// Adds what another one said.
void add(const Bytes& bytes, SphereId first, std::vector<std::uint64_t>& count) {
  ByteReader in(bytes);
  std::array<std::uint32_t, 1024> some;
  for (const auto& [run, size] : in.get_list<CountShare::Header>()) {
    std::uint64_t* to = count.data() + (run - first);
    for (std::uint64_t left = size; left > 0;) {
      const auto now = std::span(some).first(std::min<std::uint64_t>(left, some.size()));
      in.get_all(now);
      for (const std::uint32_t collisions : now) *to++ += collisions;
      left -= now.size();
    }
  }
  for (const auto& [sphere, collisions] : in.get_list<Counted>()) count[sphere - first] += collisions;
}

/// Pairs to the ranks on which their first spheres began.
std::vector<Message> shares_of(PairLists pairs, std::span<const SphereId> starts, unsigned ranks) {
  std::vector<std::uint64_t> sizes(ranks, 0);
  for (const auto& list : pairs)
    for (const IdPair& pair : list) ++sizes[owner_of(starts, pair.i)];
  std::vector<ByteWriter> shares(ranks);
  for (unsigned rank = 0; rank < ranks; ++rank) {
    if (sizes[rank] == 0) continue;
    shares[rank].reserve(sizeof sizes[rank] + sizes[rank] * sizeof(IdPair));
    shares[rank].put(sizes[rank]);
  }
  for (auto& list : pairs) {
    for (const IdPair& pair : list) shares[owner_of(starts, pair.i)].put(pair);
    std::vector<IdPair>().swap(list);
  }
  std::vector<Message> out;
  for (unsigned rank = 0; rank < ranks; ++rank)
    if (sizes[rank] > 0) out.push_back({rank, shares[rank].take()});
  return out;
}

}  // namespace

std::vector<std::uint64_t> return_counts(Communicator& ranks, std::span<const SphereId> starts,
                                         std::span<const CountRun> runs, std::span<const Counted> more) {
  std::vector<CountShare> shares(ranks.size());
  for (const CountRun& run : runs) share_out(shares, starts, run);
  for (const Counted& counted : more) shares[owner_of(starts, counted.sphere)].more.push_back(counted);
  const unsigned own = ranks.rank();
  std::vector<Message> out;
  for (unsigned rank = 0; rank < ranks.size(); ++rank)
    if (rank != own && !shares[rank].empty()) out.push_back({rank, shares[rank].packed()});
  std::vector<Message> in = ranks.exchange(std::move(out));
  std::vector<std::uint64_t> count;
  resize_large(count, starts[own + 1] - starts[own]);
  add(shares[own], starts[own], count);
  for (Message& message : in) {
    add(message.bytes, starts[own], count);
    Bytes().swap(message.bytes);
  }
  return count;
}

std::vector<IdPair> return_pairs(Communicator& ranks, std::span<const SphereId> starts, PairLists pairs) {
  std::vector<std::vector<IdPair>> lists;
  for (Message& message : ranks.exchange(shares_of(std::move(pairs), starts, ranks.size()))) {
    lists.push_back(ByteReader(message.bytes).get_list<IdPair>());
    Bytes().swap(message.bytes);
  }
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
