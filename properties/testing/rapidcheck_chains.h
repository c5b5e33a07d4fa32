#pragma once
#include <rapidcheck.h>

#include <algorithm>
#include <ostream>

#include "catena/core/readers/chain_format.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/generators/simplifications.h"

namespace catena::properties {

/// Simplifications as RapidCheck takes them: one after the other.
class SimplerChains {
 public:
  explicit SimplerChains(const Chain& chain) : candidates_(chain) {}
  rc::Maybe<Chain> operator()() {
    auto simpler = candidates_.next();
    return simpler ? rc::Maybe<Chain>(std::move(*simpler)) : rc::Nothing;
  }

 private:
  Simplifications candidates_;
};

/// Chains of a family, with up to as many spheres as RapidCheck's size (100 at the end of a run), which
/// shrink to chains: fewer spheres, a plainer rule, rounder numbers.
inline rc::Gen<Chain> chains_of(Family family) {
  return rc::Gen<Chain>([family = std::move(family)](const rc::Random& random, int size) {
    rc::Random seed(random);
    Dice dice(seed.next());
    Chain chain = generate(family, dice, static_cast<std::uint32_t>(std::max(1, size)));
    return rc::shrinkable::shrinkRecur(std::move(chain),
                                       [](const Chain& c) { return rc::makeSeq<SimplerChains>(c); });
  });
}

}  // namespace catena::properties

namespace rc {

/// A chain of any family.
template <>
struct Arbitrary<catena::Chain> {
  static Gen<catena::Chain> arbitrary() {
    return gen::mapcat(
        gen::elementOf(catena::properties::FamilyRegistry::instance().families()),
        [](const catena::properties::Family& family) { return catena::properties::chains_of(family); });
  }
};

}  // namespace rc

namespace catena {

/// A counterexample is shown as a chain file, ready for `catena fuzz --replay`.
inline void showValue(const Chain& chain, std::ostream& out) { write_chain(out << '\n', chain); }

}  // namespace catena
