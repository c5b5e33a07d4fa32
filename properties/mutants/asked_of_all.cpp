#include "catena/properties/mutants/asked_of_all.h"

#include <algorithm>

#include "catena/core/error.h"

namespace catena::properties {

void leave_what_was_asked(const Request& request, Collisions& result) {
  std::vector<std::uint32_t>& count = result.count;
  for (std::uint32_t i = 0; i < count.size(); ++i)
    if (!request.queries.contains(i)) count[i] = 0;
  std::erase_if(result.pairs, [&](const Pair& pair) { return !request.queries.contains(pair.i); });
  result.pair_count = result.pairs.size();
  result.found = result.pair_count > 0;
  if (request.want != Request::Want::pairs) result.pairs.clear();
  if (request.want == Request::Want::any) count.clear(), result.pair_count = 0;
  if (request.want != Request::Want::pairs || result.pair_count <= request.pair_limit) return;
  result.pairs.clear();
  throw PairLimitExceeded(result.pair_count, request.pair_limit);
}

}  // namespace catena::properties
