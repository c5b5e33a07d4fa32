#include <algorithm>

#include "catena/properties/generators/draft.h"
#include "catena/properties/statements/relation.h"

namespace catena::properties {
namespace {

/// Strands in another order, each as it was: the same pairs under their new numbers.
class RelabelledStrands final : public Relation {
 public:
  std::string name() const override { return "relabelled strands"; }

  std::optional<Image> image(const Case& test) const override {
    const Chain& chain = test.chain;
    const std::uint32_t strands = chain.strand_count();
    if (strands < 2) return std::nullopt;
    Draft draft{{}, {{0}, {}}, chain.exclusion()};
    std::vector<std::uint32_t> label(chain.size());
    for (std::uint32_t k = 0; k < strands; ++k) {
      const std::uint32_t s = (k + 1 + strands / 2) % strands;  // a rotation: every strand moves
      for (std::uint32_t i = chain.strands().first[s]; i < chain.strands().first[s + 1]; ++i) {
        label[i] = draft.size();
        draft.spheres.push_back(chain[i]);
      }
      draft.strands.first.push_back(draft.size());
      draft.strands.closed.push_back(chain.strands().closed[s]);
    }
    const auto relabelled = [&](const Pair& p) {
      const auto [i, j] = std::minmax(label[p.i], label[p.j]);
      return Pair{i, j};
    };
    auto& joints = draft.exclusion.extra_pairs;
    std::ranges::transform(joints, joints.begin(), relabelled);
    std::vector<Pair> pairs;
    std::ranges::transform(test.exact.pairs, std::back_inserter(pairs), relabelled);
    return Image{std::move(draft).chain(), std::move(pairs)};
  }
};

const RegisterProperty<RelabelledStrands> registered;

}  // namespace
}  // namespace catena::properties
