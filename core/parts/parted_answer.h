#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "catena/core/executor/team.h"
#include "catena/core/parts/local_chain.h"
#include "catena/core/strategy/request.h"

namespace catena::parts {

/// The answer of a whole chain, made of what its parts found. Parts may be taken by several threads at a
/// time.
class PartedAnswer {
 public:
  explicit PartedAnswer(const Team& team) : team_(team) {}

  /// For so many parts, and one more for what is between them. The result is written until gather.
  void begin(const Request& request, std::uint32_t spheres, std::size_t parts, Collisions& result);

  /// What a search of a part is to be asked for, with memory for its pairs in `found`.
  Request asked(std::size_t k, const LocalChain& part, Collisions& found);
  /// Where the counts of its own spheres go: their place in the result when they lie together there, else
  /// `apart`.
  std::span<std::uint32_t> place_of_counts(const LocalChain& part, std::vector<std::uint32_t>& apart) const;
  /// What it found, its counts in that place.
  void take(std::size_t k, const LocalChain& part, std::span<const std::uint32_t> count, Collisions& found);
  /// It found so many pairs, more than the limit.
  void take_too_many(std::size_t k, std::uint64_t pairs);

  /// As asked, for what is between parts that were searched without halos: all pairs.
  Request asked_between(const LocalChain& between, Collisions& found);
  /// What was found there; those of two parts count, of which group g is of the one that `part_of` says.
  void take_between(const LocalChain& between,
                    const std::function<std::size_t(std::uint32_t sphere)>& part_of, Collisions& found);

  /// One pair is enough, and there is one.
  bool is_answered(std::size_t k) const { return request_.want == Request::Want::any && found_[k].any; }

  /// The pairs of all parts, part after part. Throws PairLimitExceeded with the true number.
  void gather();

 private:
  /// What a part found, in the numbers of the whole chain.
  struct Found {
    bool any = false;
    std::uint64_t pairs = 0;
    std::vector<Pair> list;  ///< its memory is kept from answer to answer
  };

  bool asks_for_all() const { return request_.queries.within(spheres_) == SphereRange{0, spheres_}; }
  bool lie_together(const LocalChain& part) const;
  void take_counts(const LocalChain& part, std::span<const std::uint32_t> count);
  void take_pairs(const LocalChain& part, Collisions& found, Found& to) const;
  void leave_out_unasked(Found& found) const;
  template <class Body>
  void for_each_stretch(std::size_t count, const Body& body) const;

  const Team& team_;
  Request request_;
  std::uint32_t spheres_ = 0;
  Collisions* result_ = nullptr;
  std::vector<Found> found_;  ///< of each part, and between them
};

}  // namespace catena::parts
