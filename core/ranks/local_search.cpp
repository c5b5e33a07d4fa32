#include "catena/core/ranks/local_search.h"

#include <algorithm>
#include <utility>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"

namespace catena::ranks {
namespace {

/// Most pairs that are held at once only to look at them, so many or so many a sphere; where more are found,
/// half of them, but no more than the last.
constexpr std::uint64_t few_pairs = 1u << 22, pairs_a_sphere = 8, most_pairs = 1u << 27;

/// Where the chain takes some neighbours for colliding, or some pairs are not asked for.
std::vector<std::uint32_t> search_and_sift(const HeldPart& part, Variant& variant, KeptPairs& kept) {
  std::vector<std::uint32_t> count(part.chain().size(), 0);
  for_each_pair(variant, part.chain(), {0, part.chain().size()}, [&](const Pair& pair) {
    if (part.misses_neighbours() && part.neighbours(part.place(pair.i), part.place(pair.j))) return;
    ++count[pair.i], ++count[pair.j];
    kept.add(part.id(pair.i), part.id(pair.j));
  });
  return count;
}

std::vector<std::uint32_t> search_as_asked(const HeldPart& part, Variant& variant, Request::Want want,
                                           std::uint64_t limit, KeptPairs& kept) {
  Collisions found;
  Request request{.want = want, .pair_limit = limit};
  try {
    variant.find(part.chain(), request, found);
  } catch (const PairLimitExceeded&) {  // counted all the same
    request.want = Request::Want::counts;
    variant.find(part.chain(), request, found);
  }
  if (want == Request::Want::any) {
    kept.add_uncounted(found.found ? 1 : 0);
  } else {
    if (!found.pairs.empty()) kept.reserve(found.pairs.size());
    for (const Pair& pair : found.pairs) kept.add(part.id(pair.i), part.id(pair.j));
    kept.add_uncounted(found.pair_count - found.pairs.size());
  }
  return std::move(found.count);
}

/// What the chain takes for neighbours and the rule does not.
void add_passed(const HeldPart& part, Request::Want want, std::vector<std::uint32_t>& count,
                KeptPairs& kept) {
  part.for_each_passed([&](std::uint32_t i, std::uint32_t j) {
    if (!Robust::overlap(part.chain()[i], part.chain()[j])) return;
    if (want != Request::Want::any) ++count[i], ++count[j];
    kept.add(part.id(i), part.id(j));
  });
}

}  // namespace

void for_each_pair(Variant& variant, const Chain& chain, SphereRange range,
                   const std::function<void(const Pair&)>& visit, std::uint64_t at_once) {
  if (at_once == 0) at_once = std::max(few_pairs, pairs_a_sphere * chain.size());
  range = range.within(chain.size());
  Collisions found;
  const auto search = [&](SphereRange some, std::uint64_t limit) {
    variant.find(chain, {.want = Request::Want::pairs, .pair_limit = limit, .queries = some}, found);
    for (const Pair& pair : found.pairs) visit(pair);
  };
  try {
    return search(range, at_once);
  } catch (const PairLimitExceeded& exceeded) {
    at_once = std::max(at_once, std::min(most_pairs, exceeded.found() / 2));
  }
  // Spheres begin no more pairs than they have collisions.
  variant.find(chain, {.want = Request::Want::counts, .queries = range}, found);
  const std::vector<std::uint32_t> count = std::exchange(found.count, {});
  for (std::uint32_t begin = range.begin, end = begin; begin < range.end; begin = end) {
    std::uint64_t sum = count[end++];
    while (end < range.end && sum + count[end] <= at_once) sum += count[end++];
    if (sum > 0) search({begin, end}, sum);
  }
}

std::vector<std::uint32_t> search_within(const HeldPart& part, Variant& variant, Request::Want want,
                                         std::uint64_t limit, KeptPairs& kept) {
  std::vector<std::uint32_t> count = is_sifted(part, kept)
                                         ? search_and_sift(part, variant, kept)
                                         : search_as_asked(part, variant, want, limit, kept);
  add_passed(part, want, count, kept);
  return count;
}

}  // namespace catena::ranks
