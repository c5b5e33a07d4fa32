#include <fmt/format.h>

#include <algorithm>

#include "catena/core/error.h"
#include "catena/properties/property.h"
#include "catena/properties/sorted_pairs.h"

namespace catena::properties {
namespace {

/// A limit on pairs loses nothing in silence: at the number of pairs the answer is complete; below it the
/// error states the true number, leaves no pairs, and the variant answers the next request as if nothing had
/// happened.
class PairLimit final : public Property {
 public:
  std::string name() const override { return "pair limit"; }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    variant.build(test.chain);
    variant.find(test.chain, {}, complete_);
    const std::uint64_t pairs = complete_.pair_count;
    if (pairs == 0) return std::nullopt;
    for (const std::uint64_t limit : {pairs - 1, pairs / 2, std::uint64_t{0}}) {
      try {
        variant.find(test.chain, {Request::Want::pairs, limit}, limited_);
        return fmt::format("{} pairs pass a limit of {}", limited_.pairs.size(), limit);
      } catch (const PairLimitExceeded& error) {
        if (error.found() != pairs || error.limit() != limit)
          return fmt::format("says {} pairs, limit {}; there are {}, limit {}", error.found(), error.limit(),
                             pairs, limit);
        if (!limited_.pairs.empty())
          return fmt::format("leaves {} pairs past the limit", limited_.pairs.size());
      }
    }
    variant.find(test.chain, {Request::Want::counts, 0}, limited_);  // a limit on pairs, not on counts
    if (limited_.count != complete_.count) return "counts differ under a limit on pairs";
    variant.find(test.chain, {Request::Want::pairs, pairs}, limited_);
    sort(limited_.pairs);  // a device gives them in any order
    sort(complete_.pairs);
    if (limited_.pairs != complete_.pairs)
      return fmt::format("pairs differ under the limit {} that they reach", pairs);
    return std::nullopt;
  }

 private:
  Collisions complete_, limited_;
};

const RegisterProperty<PairLimit> registered;

}  // namespace
}  // namespace catena::properties
