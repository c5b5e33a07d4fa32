#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "catena/properties/property.h"
#include "catena/properties/sorted_pairs.h"

namespace catena::properties {
namespace {

/// Searches for parts of the chain add up to the search for all of it: each count comes from the part that
/// has its sphere and is nothing in the others, each pair from the part that has its first sphere. So devices
/// and ranks can share one search.
class QueryRanges final : public Property {
 public:
  std::string name() const override { return "query ranges"; }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    const std::uint32_t n = test.chain.size();
    variant.build(test.chain);
    variant.find(test.chain, {}, whole_);
    const std::array<std::uint32_t, 6> ends{0, n / 7, n / 7, std::min(n, n / 2 + 1), n, n};
    pairs_.clear();
    counts_.assign(n, 0);
    for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
      Request request;
      request.queries = {ends[part], part + 2 < ends.size() ? ends[part + 1] : 0xFFFFFFFFu};
      if (auto fault = search(variant, test.chain, request)) return fault;
    }
    sort(whole_.pairs);
    sort(pairs_);
    if (pairs_ != whole_.pairs)
      return fmt::format("{} pairs by parts, {} of the whole, or others", pairs_.size(), whole_.pairs.size());
    if (counts_ != whole_.count) return "counts by parts are not those of the whole";
    return std::nullopt;
  }

 private:
  std::optional<std::string> search(Variant& variant, const Chain& chain, Request request) {
    const auto& asked = request.queries;
    variant.find(chain, request, part_);
    for (std::uint32_t i = 0; i < chain.size(); ++i) {
      if (!asked.contains(i) && part_.count[i] != 0) return fmt::format("sphere {} was not asked about", i);
      counts_[i] += part_.count[i];
    }
    for (const Pair& p : part_.pairs)
      if (!asked.contains(p.i)) return fmt::format("pair ({}, {}) was not asked about", p.i, p.j);
    pairs_.insert(pairs_.end(), part_.pairs.begin(), part_.pairs.end());
    const std::uint64_t found = part_.pairs.size();
    if (part_.pair_count != found)
      return fmt::format("{} pairs of a part, but pair_count {}", found, part_.pair_count);
    request.want = Request::Want::any;
    variant.find(chain, request, part_);
    if (part_.found != (found > 0))
      return fmt::format("a part with {} pairs says found = {}", found, part_.found);
    return std::nullopt;
  }

  Collisions whole_, part_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> counts_;
};

const RegisterProperty<QueryRanges> registered;

}  // namespace
}  // namespace catena::properties
