#include "catena/core/plan/part_look.h"

#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"

namespace catena {

std::optional<Pair> PartLook::look(const ChainView& chain, const SphereRange& queries) {
  // Under an arc window near spheres along the chain overlap, and are no pairs.
  if (!pays(chain.size) || chain.exclusion.rule != Exclusion::Rule::index_window) return std::nullopt;
  const std::uint32_t size = chain.size / parts, first = (chain.size - size) / 2;
  if (search_ == nullptr) search_ = StrategyRegistry::instance().make("Hybrid");
  if (shape_.size() != size || shape_.exclusion().window != chain.exclusion.window)
    shape_ = Chain(std::vector<Sphere>(size), {}, Exclusion::index(chain.exclusion.window));
  std::vector<Sphere> spheres = std::move(part_).release();
  spheres.assign(chain.spheres + first, chain.spheres + first + size);
  part_ = shape_.moved(std::move(spheres));
  Request request;
  request.pair_limit = 64 * std::uint64_t{size};  // where more collide others have found one
  search_->build(part_);
  try {
    search_->find(part_, request, found_);
  } catch (const PairLimitExceeded&) {
    return std::nullopt;
  }
  // Strands and further neighbours are those of the chain.
  for (const Pair& p : found_.pairs)
    if (const std::uint32_t i = first + p.i, j = first + p.j; queries.contains(i) && !chain.neighbours(i, j))
      return Pair{i, j};
  return std::nullopt;
}

}  // namespace catena
