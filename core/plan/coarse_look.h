#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/pair.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// A quick look for one colliding pair where it is likeliest: stretches of the chain, seen by one sphere
/// each, are laid into cells one after the other, and where one comes near another the nearest spheres of the
/// two are compared exactly, and of each one sphere with those next along the chain. What it gives is a
/// colliding pair; nothing found proves nothing.
class CATENA_API CoarseLook {
 public:
  static constexpr std::uint32_t stretch = 1024;  ///< spheres
  static constexpr std::uint32_t least = 8 * stretch;
  /// Below, all is searched as quickly.
  static bool pays(std::uint32_t n) { return n >= least; }

  /// A colliding pair i < j with i in `queries`. O(n / stretch), and as many comparisons of two stretches at
  /// most. Does not allocate when n has not grown.
  std::optional<Pair> look(const ChainView& chain, const SphereRange& queries);
  /// The same among the spheres around i and j alone, such as those that collided in the frame before.
  static std::optional<Pair> look_near(const ChainView& chain, const SphereRange& queries, const Pair& pair);

  /// Comparisons of two stretches in the last look.
  std::uint32_t compared() const { return compared_; }

 private:
  /// A stretch around its middle sphere, as far as half way to those of the stretches beside it.
  struct Stretch {
    float x, y, z, reach;
    std::int32_t cell[3];
    std::uint32_t next;  ///< in the same bucket
  };
  void lay_out(const ChainView& chain);
  static std::optional<Pair> look_along(const ChainView& chain, const SphereRange& queries, std::uint32_t i);
  std::uint32_t bucket(std::uint32_t hash) const;  ///< of a cell
  static std::optional<Pair> compare(const ChainView& chain, const SphereRange& queries, std::uint32_t a,
                                     std::uint32_t b);

  std::vector<Stretch> stretches_;
  std::vector<std::uint32_t> buckets_;  ///< a power of two of them: the last stretch laid in
  std::uint32_t compared_ = 0;
};

}  // namespace catena
