#include "catena/reference/reference.h"

#include "catena/reference/all_pairs.h"
#include "catena/reference/grid.h"

namespace catena::reference {

Answer find(const Chain& chain, const Request& request) {
  constexpr std::uint32_t quick = 4000;  // 8 million pairs: some tens of milliseconds
  return chain.size() <= quick ? all_pairs(chain, request).answer : by_grid(chain, request);
}

}  // namespace catena::reference
