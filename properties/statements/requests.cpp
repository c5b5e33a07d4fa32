#include <fmt/format.h>

#include <algorithm>

#include "catena/properties/property.h"

namespace catena::properties {
namespace {

/// Whatever is asked for, and known before the build, it is the same answer: `any` knows whether there is a
/// pair, `counts` and `pairs` count alike, and what was not asked for is not there.
class Requests final : public Property {
  using Want = Request::Want;

 public:
  std::string name() const override { return "requests agree"; }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    ask(variant, test.chain, Want::any, any_);
    const Request half{.want = Want::any, .queries = {test.chain.size() / 2, test.chain.size()}};
    variant.prepare(half);  // what the next build is for changes nothing of this one
    variant.find(test.chain, half, half_);
    ask(variant, test.chain, Want::counts, counts_);
    ask(variant, test.chain, Want::pairs, pairs_);
    less_ = pairs_;                                // what an earlier answer left is none of the next one
    variant.find(test.chain, {Want::any}, less_);  // less than was prepared for
    if (!less_.pairs.empty()) return "pairs of an earlier answer are left where yes or no was asked";
    if (!less_.count.empty()) return "counts of an earlier answer are left where yes or no was asked";
    if (less_.found != pairs_.found) return "found differs when less is asked for than was prepared";
    less_ = pairs_;
    variant.find(test.chain, {Want::counts}, less_);
    if (!less_.pairs.empty()) return "pairs of an earlier answer are left where counts were asked";
    if (less_.count != pairs_.count) return "counts differ when less is asked for than was prepared";
    if (pairs_.pairs.size() != pairs_.pair_count)
      return fmt::format("{} pairs, but pair_count {}", pairs_.pairs.size(), pairs_.pair_count);
    if (pairs_.count != counts_.count) return "counts differ between a request for pairs and one for counts";
    if (pairs_.pair_count != counts_.pair_count)
      return fmt::format("pair_count {} with pairs, {} with counts", pairs_.pair_count, counts_.pair_count);
    const bool found = pairs_.pair_count > 0;
    if (any_.found != found || counts_.found != found || pairs_.found != found)
      return fmt::format("{} pairs, but found is {} (any), {} (counts), {} (pairs)", pairs_.pair_count,
                         any_.found, counts_.found, pairs_.found);
    if (half_.found !=
        std::ranges::any_of(pairs_.pairs, [&](const Pair& p) { return half.queries.contains(p.i); }))
      return fmt::format("found is {} for the spheres from {} on", half_.found, half.queries.begin);
    if (!counts_.pairs.empty() || !any_.pairs.empty()) return "pairs that nobody asked for";
    return std::nullopt;
  }

 private:
  static void ask(Variant& variant, const Chain& chain, Want want, Collisions& found) {
    variant.prepare({want});
    variant.build(chain);
    variant.find(chain, {want}, found);
  }

  Collisions pairs_, any_, counts_, less_, half_;
};

const RegisterProperty<Requests> registered;

}  // namespace
}  // namespace catena::properties
