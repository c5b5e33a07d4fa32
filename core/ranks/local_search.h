#pragma once
#include <functional>

#include "catena/core/ranks/held_part.h"
#include "catena/core/strategy/variant.h"

namespace catena::ranks {

/// Pairs that a rank found, of which it keeps no more than a limit; all are counted.
class KeptPairs {
 public:
  /// `limit` 0 keeps none.
  explicit KeptPairs(std::uint64_t limit) : limit_(limit) {}
  void add(SphereId a, SphereId b) {
    ++found_;
    if (found_ <= limit_)
      pairs_.push_back({std::min(a, b), std::max(a, b)});
    else if (!pairs_.empty())
      std::vector<IdPair>().swap(pairs_);
  }
  void reserve(std::uint64_t more) { pairs_.reserve(pairs_.size() + std::min(more, limit_)); }
  void add_uncounted(std::uint64_t pairs) { found_ += pairs; }
  std::uint64_t found() const { return found_; }
  std::vector<IdPair> take() { return std::move(pairs_); }

 private:
  const std::uint64_t limit_;
  std::uint64_t found_ = 0;
  std::vector<IdPair> pairs_;
};

/// visit(pair) for every pair of the chain, for which the variant was built, whose first sphere is one of
/// these. Where there are too many to be held at once, half the spheres are searched for at a time: rare, and
/// as slow as it is often.
void for_each_pair(Variant& variant, const Chain& chain, SphereRange range,
                   const std::function<void(const Pair&)>& visit);

/// What search_within asks of the variant for this.
inline Request::Want asked_within(const HeldPart& part, Request::Want want) {
  return part.misses_neighbours() ? Request::Want::pairs : want;
}

/// What collides within a part, by a variant that was built for its chain: adds to `kept`, and returns the
/// collisions of each sphere. For Want::any only whether something does: then kept.found() is not 0, and
/// nothing is returned.
std::vector<std::uint32_t> search_within(const HeldPart& part, Variant& variant, Request::Want want,
                                         std::uint64_t limit, KeptPairs& kept);

}  // namespace catena::ranks
