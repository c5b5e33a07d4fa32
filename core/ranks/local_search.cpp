#include "catena/core/ranks/local_search.h"

#include <algorithm>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"

namespace catena::ranks {
namespace {

/// Most pairs that are held at once only to look at them, so many or so many a sphere.
constexpr std::uint64_t most_at_once = 1u << 22, pairs_a_sphere = 8;

/// Where the chain takes some neighbours for colliding.
std::vector<std::uint32_t> search_and_sift(const HeldPart& part, Variant& variant, KeptPairs& kept) {
  std::vector<std::uint32_t> count(part.chain().size(), 0);
  for_each_pair(variant, part.chain(), {0, part.chain().size()}, [&](const Pair& pair) {
    const Place a = part.place(pair.i), b = part.place(pair.j);
    if (part.neighbours(a, b)) return;
    ++count[pair.i], ++count[pair.j];
    kept.add(a.id, b.id);
  });
  return count;
}

/// What the chain takes for neighbours and the rule does not.
void add_passed(const HeldPart& part, Request::Want want, std::vector<std::uint32_t>& count,
                KeptPairs& kept) {
  part.for_each_passed([&](std::uint32_t i, std::uint32_t j) {
    if (!Robust::overlap(part.chain()[i], part.chain()[j])) return;
    if (want == Request::Want::any) return kept.add_uncounted(1);
    ++count[i], ++count[j];
    kept.add(part.id(i), part.id(j));
  });
}

}  // namespace

void for_each_pair(Variant& variant, const Chain& chain, SphereRange range,
                   const std::function<void(const Pair&)>& visit) {
  Collisions found;
  const std::uint64_t n = chain.size(),
                      limit = range.size() > 1 ? std::max(most_at_once, pairs_a_sphere * n) : n;
  try {
    variant.find(chain, {.want = Request::Want::pairs, .pair_limit = limit, .queries = range}, found);
  } catch (const PairLimitExceeded&) {
    const std::uint32_t middle = range.begin + range.size() / 2;
    for_each_pair(variant, chain, {range.begin, middle}, visit);
    for_each_pair(variant, chain, {middle, range.end}, visit);
    return;
  }
  for (const Pair& pair : found.pairs) visit(pair);
}

std::vector<std::uint32_t> search_within(const HeldPart& part, Variant& variant, Request::Want want,
                                         std::uint64_t limit, KeptPairs& kept) {
  if (part.misses_neighbours()) return search_and_sift(part, variant, kept);
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
  std::vector<std::uint32_t> count = std::move(found.count);
  add_passed(part, want, count, kept);
  return count;
}

}  // namespace catena::ranks
