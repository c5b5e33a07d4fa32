#pragma once
#include <cstdint>

#include "catena/core/chain/chain_view.h"
#include "catena/core/host_device.h"

namespace catena::policy {

/// GPU1 (Section 3): one thread per sphere compares it with every other sphere. O(n) a sphere.
template <class Arithmetic>
class GPU1 {
 public:
  template <class V>
  CATENA_HD static void visit(std::uint32_t i, const ChainView& chain, V& visitor) {
    const auto sphere = Arithmetic::bound(chain.spheres[i]);
    const std::uint32_t whole = chain.size - chain.size % batch;
    for (std::uint32_t first = 0; first < whole; first += batch) {
      decide(i, first, batch, near(sphere, chain.spheres + first, batch), chain, visitor);
      visitor.converge();
    }
    const std::uint32_t rest = chain.size - whole;
    decide(i, whole, rest, near(sphere, chain.spheres + whole, rest), chain, visitor);
  }

 private:
  using Bound = typename Arithmetic::Bound;
  static constexpr std::uint32_t batch = 8;

  /// Bit k: the sphere and spheres[k] are not separate for certain. Without calls and branches, so that the
  /// loads and comparisons of a batch overlap in time.
  CATENA_HD static std::uint32_t near(const Bound& sphere, const Sphere* spheres, std::uint32_t count) {
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < count; ++k)
      bits |= static_cast<std::uint32_t>(!Arithmetic::separate(sphere, Arithmetic::bound(spheres[k]))) << k;
    return bits;
  }

  template <class V>
  CATENA_HD static void decide(std::uint32_t i, std::uint32_t first, std::uint32_t count, std::uint32_t bits,
                               const ChainView& chain, V& visitor) {
    visitor.tested_batch(first, count, bits);
    for (std::uint32_t j = first; bits != 0; ++j, bits >>= 1) {
      if ((bits & 1u) == 0 || j == i) continue;
      if (chain.neighbours(i, j)) {
        visitor.excluded(j);
        continue;
      }
      visitor.tested_pair(j);
      if (Arithmetic::overlap(Arithmetic::bound(chain.spheres[i]), Arithmetic::bound(chain.spheres[j])))
        visitor.hit(j);
    }
  }
};

}  // namespace catena::policy
