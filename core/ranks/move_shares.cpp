#include "catena/core/ranks/move_shares.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "catena/core/executor/give_back_pages.h"
#include "catena/core/executor/large_vector.h"

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

/// Copies what is left of a share before this place of the part, and returns where it ends.
template <class Value>
Value* copy_until(std::uint64_t end, const Share& share, Gone& gone, const std::vector<Value>& values,
                  Value* to) {
  for_each_until(end, share, gone, [&](std::uint64_t begin, std::uint64_t size) {
    to = std::copy_n(values.data() + begin, size, to);
  });
  return to;
}

/// Where what comes of each rank, and what stays, begins.
std::vector<std::uint64_t> places_of(std::span<const std::uint64_t> coming) {
  std::vector<std::uint64_t> first(coming.size());
  std::exclusive_scan(coming.begin(), coming.end(), first.begin(), std::uint64_t{0});
  return first;
}

}  // namespace

template <class Value>
void move_shares(Communicator& ranks, const std::vector<Share>& shares, std::span<const std::uint64_t> coming,
                 std::uint64_t rounds, std::vector<Value>& values) {
  const unsigned own = ranks.rank();
  std::vector<std::uint64_t> next = places_of(coming);
  std::vector<std::uint64_t> ends = next;
  for (unsigned rank = 0; rank < ranks.size(); ++rank) ends[rank] += coming[rank];
  std::vector<Value> all;
  resize_large(all, ends.back());
  LargeVector<Value> packed;
  std::vector<Gone> gone(ranks.size());
  std::uint64_t begin = 0, given = 0;
  for (std::uint64_t round = 1; round <= rounds; ++round) {
    const std::uint64_t end = values.size() * round / rounds;
    packed.resize(std::max<std::size_t>(packed.size(), end - begin));
    std::vector<Outgoing> out;
    Value* to = packed.data();
    for (unsigned rank = 0; rank < ranks.size(); ++rank) {
      if (rank == own) continue;
      Value* const from = std::exchange(to, copy_until(end, shares[rank], gone[rank], values, to));
      if (to > from) out.push_back({rank, std::as_bytes(std::span<const Value>(from, to))});
    }
    Value* const stay = all.data() + next[own];
    next[own] += static_cast<std::uint64_t>(copy_until(end, shares[own], gone[own], values, stay) - stay);
    constexpr std::size_t page = large_page / sizeof(Value);
    if (const std::uint64_t moved = (end - given) / page * page; moved > 0) {
      give_back_pages(values.data() + given, moved * sizeof(Value));
      given += moved;
    }
    begin = end;
    ranks.exchange_in_place(out, [&](unsigned rank, std::size_t bytes) {
      const std::uint64_t at = next[rank];
      next[rank] += bytes / sizeof(Value);
      if (next[rank] > ends[rank]) throw std::logic_error("more comes of a rank than was told");
      return reinterpret_cast<std::byte*>(all.data() + at);
    });
  }
  values = std::move(all);
}

template void move_shares(Communicator&, const std::vector<Share>&, std::span<const std::uint64_t>,
                          std::uint64_t, std::vector<Sphere>&);
template void move_shares(Communicator&, const std::vector<Share>&, std::span<const std::uint64_t>,
                          std::uint64_t, std::vector<double>&);

}  // namespace catena::ranks
