#include "catena/core/ranks/move_shares.h"

#include <algorithm>
#include <span>

#include "catena/core/executor/give_back_pages.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

/// How far a share has gone.
struct Gone {
  std::size_t run = 0;
  std::uint64_t of_run = 0;
};

/// visit(begin, size) for what is left of a share before this place of the part.
template <class Visit>
void for_each_until(std::uint64_t end, const Share& share, Gone& gone, const Visit& visit) {
  for (; gone.run < share.runs.size(); ++gone.run, gone.of_run = 0) {
    const std::uint64_t begin = share.begin[gone.run] + gone.of_run,
                        left = share.runs[gone.run].size - gone.of_run;
    if (begin >= end) return;
    const std::uint64_t size = std::min(left, end - begin);
    visit(begin, size);
    gone.of_run += size;
    if (size < left) return;
  }
}

/// Appends them, and gives back what they took.
template <class Value>
void move_to(std::vector<Value>& all, std::vector<Bytes>& came) {
  for (Bytes& bytes : came) {
    const std::size_t at = all.size();
    all.resize(at + bytes.size() / sizeof(Value));
    ByteReader(bytes).get_all(std::span(all).subspan(at));
    Bytes().swap(bytes);
  }
}
template <class Value>
void move_to(std::vector<Value>& all, std::vector<Value>& values) {
  constexpr std::size_t at_once = std::size_t{1} << 18;
  for (std::size_t done = 0; done < values.size(); done += at_once) {
    const auto some = std::span(values).subspan(done, std::min(at_once, values.size() - done));
    all.insert(all.end(), some.begin(), some.end());
    give_back_pages(some.data(), some.size_bytes());
  }
}

}  // namespace

template <class Value>
void move_shares(Communicator& ranks, const std::vector<Share>& shares, std::uint64_t rounds,
                 std::vector<Value>& values) {
  const unsigned own = ranks.rank();
  std::vector<Gone> gone(ranks.size());
  std::vector<std::vector<Bytes>> came(ranks.size());
  std::size_t stay = 0;  // so many do, moved to the front
  for (std::uint64_t round = 1; round <= rounds; ++round) {
    const std::uint64_t end = values.size() * round / rounds;
    std::vector<Message> out;
    for (unsigned rank = 0; rank < ranks.size(); ++rank) {
      if (rank == own) continue;
      std::uint64_t going = 0;
      Gone ahead = gone[rank];
      for_each_until(end, shares[rank], ahead, [&](std::uint64_t, std::uint64_t n) { going += n; });
      if (going == 0) continue;
      ByteWriter bytes;
      bytes.reserve(going * sizeof(Value));
      for_each_until(end, shares[rank], gone[rank], [&](std::uint64_t begin, std::uint64_t n) {
        bytes.put_all(std::span<const Value>(values).subspan(begin, n));
      });
      out.push_back({rank, bytes.take()});
    }
    for_each_until(end, shares[own], gone[own], [&](std::uint64_t begin, std::uint64_t n) {
      if (stay < begin)
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(begin), n,
                    values.begin() + static_cast<std::ptrdiff_t>(stay));
      stay += n;
    });
    give_back_pages(values.data() + stay, (end - stay) * sizeof(Value));
    for (Message& message : ranks.exchange(std::move(out)))
      came[message.rank].push_back(std::move(message.bytes));
  }
  values.resize(stay);
  std::size_t size = stay;
  for (const auto& of_rank : came)
    for (const Bytes& bytes : of_rank) size += bytes.size() / sizeof(Value);
  std::vector<Value> all;
  all.reserve(size);
  wish_large_pages(all.data(), size * sizeof(Value));
  for (unsigned rank = 0; rank < ranks.size(); ++rank)
    rank == own ? move_to(all, values) : move_to(all, came[rank]);
  values = std::move(all);
}

template void move_shares(Communicator&, const std::vector<Share>&, std::uint64_t, std::vector<Sphere>&);
template void move_shares(Communicator&, const std::vector<Share>&, std::uint64_t, std::vector<double>&);

}  // namespace catena::ranks
