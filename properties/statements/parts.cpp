#include <algorithm>

#include "catena/properties/generators/draft.h"
#include "catena/properties/statements/relation.h"

namespace catena::properties {
namespace {

/// A part of the chain on its own has the pairs that lie within it. A closed strand is not cut (its ends
/// would be neighbours no more), nor any strand under an arc window (its lengths would be summed from another
/// start).
class Part : public Relation {
 public:
  std::optional<Image> image(const Case& test) const override {
    const auto cut = cut_of(test.chain);
    if (!cut) return std::nullopt;
    const std::uint32_t n = test.chain.size(), begin = first_half() ? 0 : *cut, end = first_half() ? *cut : n;
    Draft draft = Draft::of(test.chain);
    draft.remove(end, n - end);
    draft.remove(0, begin);
    std::vector<Pair> pairs;
    for (const Pair& p : test.exact.pairs)
      if (p.i >= begin && p.j < end) pairs.push_back({p.i - begin, p.j - begin});
    return Image{std::move(draft).chain(), std::move(pairs)};
  }

 private:
  virtual bool first_half() const = 0;

  static std::optional<std::uint32_t> cut_of(const Chain& chain) {
    const std::uint32_t half = chain.size() / 2;
    const auto& [first, closed] = chain.strands();
    const auto after = std::ranges::upper_bound(first, half);
    if (half == 0) return std::nullopt;
    const auto strand = static_cast<std::size_t>(after - first.begin()) - 1;
    if (first[strand] == half) return half;
    if (closed[strand] == 0 && chain.exclusion().rule == Exclusion::Rule::index_window) return half;
    if (first[strand] > 0) return first[strand];
    if (*after < chain.size()) return *after;
    return std::nullopt;
  }
};

class FirstPart final : public Part {
 public:
  std::string name() const override { return "first part on its own"; }

 private:
  bool first_half() const override { return true; }
};

class SecondPart final : public Part {
 public:
  std::string name() const override { return "second part on its own"; }

 private:
  bool first_half() const override { return false; }
};

const RegisterProperty<FirstPart> first;
const RegisterProperty<SecondPart> second;

}  // namespace
}  // namespace catena::properties
