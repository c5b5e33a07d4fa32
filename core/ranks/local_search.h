#pragma once
#include <functional>

#include "catena/core/ranks/held_part.h"
#include "catena/core/strategy/variant.h"

namespace catena::ranks {

/// Pairs in several lists, which none has to copy that grows.
using PairLists = std::vector<std::vector<IdPair>>;

/// Pairs that a rank found, and whose lower sphere is one of some: all are counted, and no more kept than a
/// limit.
class KeptPairs {
 public:
  /// `limit` 0 keeps none.
  explicit KeptPairs(std::uint64_t limit, IdRange of = {}) : limit_(limit), of_(of) {}
  void add(SphereId a, SphereId b) {
    if (!of_.contains(std::min(a, b))) return;
    ++found_;
    if (found_ <= limit_) {
      if (lists_.empty() || lists_.back().size() == lists_.back().capacity()) reserve(std::min(found_, most));
      lists_.back().push_back({std::min(a, b), std::max(a, b)});
    } else if (!lists_.empty()) {
      PairLists().swap(lists_);
    }
  }
  /// Room for so many that come next.
  void reserve(std::uint64_t more) {
    if (limit_ > 0) lists_.emplace_back().reserve(std::max(fewest, std::min(more, limit_)));
  }
  /// So many that are not told one by one, of all spheres.
  void add_uncounted(std::uint64_t pairs) { found_ += pairs; }
  /// Whether pairs of all spheres are counted; otherwise each is to be told.
  bool of_all() const { return of_.all(); }
  std::uint64_t found() const { return found_; }
  PairLists take() { return std::move(lists_); }

 private:
  static constexpr std::uint64_t fewest = 64, most = 1 << 20;  // of a list, unless more are told to come
  const std::uint64_t limit_;
  const IdRange of_;
  std::uint64_t found_ = 0;
  PairLists lists_;
};

/// visit(pair) for every pair of the chain, for which the variant was built, whose first sphere is one of
/// these. Where there are more than `at_once` (0: as many as a rank holds with ease), spheres are counted,
/// and searched for some at a time, with no more than half the pairs or `at_once`. A variant may search the
/// whole chain for a few spheres; so there are few such searches, up to 2^28 pairs however many there are.
void for_each_pair(Variant& variant, const Chain& chain, SphereRange range,
                   const std::function<void(const Pair&)>& visit, std::uint64_t at_once = 0);

/// Whether search_within looks at each pair that the variant finds.
inline bool is_sifted(const HeldPart& part, const KeptPairs& kept) {
  return part.misses_neighbours() || !kept.of_all();
}

/// What search_within asks of the variant for this.
inline Request::Want asked_within(const HeldPart& part, Request::Want want, const KeptPairs& kept) {
  return is_sifted(part, kept) ? Request::Want::pairs : want;
}

/// What collides within a part, by a variant that was built for its chain: adds to `kept`, and returns the
/// collisions of each sphere. For Want::any only whether something does, and that kept.found() is not 0 then.
std::vector<std::uint32_t> search_within(const HeldPart& part, Variant& variant, Request::Want want,
                                         std::uint64_t limit, KeptPairs& kept);

}  // namespace catena::ranks
