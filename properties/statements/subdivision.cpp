#include <algorithm>

#include "catena/properties/generators/draft.h"
#include "catena/properties/statements/relation.h"

namespace catena::properties {
namespace {

/// Each sphere twice, the window 2k + 1: sphere i becomes 2i and 2i + 1, and a pair becomes the four pairs of
/// its copies, less those that are neighbours now.
class Subdivision final : public Relation {
 public:
  std::string name() const override { return "subdivision"; }

  std::optional<Image> image(const Case& test) const override {
    const std::uint32_t n = test.chain.size();
    if (n == 0 || n > longest) return std::nullopt;
    Draft draft = Draft::of(test.chain);
    for (std::uint32_t i = n; i-- > 0;) draft.repeat(i);
    Exclusion& rule = draft.exclusion;
    if (rule.rule == Exclusion::Rule::index_window) rule.window = 2 * std::min(rule.window, n) + 1;
    rule.extra_pairs.clear();
    for (const Pair& p : test.chain.exclusion().extra_pairs)
      for (const Pair& q : copies(p)) rule.extra_pairs.push_back(q);

    Image image{std::move(draft).chain(), {}};
    const auto keep = [&](const Pair& p) {
      if (!image.chain.neighbours(p.i, p.j)) image.pairs.push_back(p);
    };
    for (const Pair& p : test.exact.pairs)
      for (const Pair& q : copies(p)) keep(q);
    for (std::uint32_t i = 0; i < n; ++i) keep({2 * i, 2 * i + 1});  // points under an arc window
    return image;
  }

 private:
  static constexpr std::uint32_t longest = 1000;

  static std::vector<Pair> copies(const Pair& p) {
    const std::uint32_t i = 2 * p.i, j = 2 * p.j;
    return {{i, j}, {i, j + 1}, {i + 1, j}, {i + 1, j + 1}};
  }
};

const RegisterProperty<Subdivision> registered;

}  // namespace
}  // namespace catena::properties
