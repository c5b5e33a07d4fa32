#include <algorithm>

#include "catena/properties/generators/draft.h"
#include "catena/properties/statements/relation.h"

namespace catena::properties {
namespace {

/// The chain from its other end: sphere i becomes n - 1 - i, and so do the pairs. Not for arc windows, whose
/// lengths would be summed in another order.
class Reversal final : public Relation {
 public:
  std::string name() const override { return "reversed chain"; }

  std::optional<Image> image(const Case& test) const override {
    if (test.chain.exclusion().rule == Exclusion::Rule::arc_window) return std::nullopt;
    const std::uint32_t n = test.chain.size();
    Draft draft = Draft::of(test.chain);
    std::ranges::reverse(draft.spheres);
    std::ranges::reverse(draft.strands.first);
    for (std::uint32_t& offset : draft.strands.first) offset = n - offset;
    std::ranges::reverse(draft.strands.closed);
    const auto turned = [n](const Pair& p) { return Pair{n - 1 - p.j, n - 1 - p.i}; };
    std::ranges::transform(draft.exclusion.extra_pairs, draft.exclusion.extra_pairs.begin(), turned);
    std::vector<Pair> pairs;
    std::ranges::transform(test.exact.pairs, std::back_inserter(pairs), turned);
    return Image{std::move(draft).chain(), std::move(pairs)};
  }
};

const RegisterProperty<Reversal> registered;

}  // namespace
}  // namespace catena::properties
