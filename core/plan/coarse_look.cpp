#include "catena/core/plan/coarse_look.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/prefetch.h"

namespace catena {
namespace {

constexpr std::uint32_t nothing = 0xFFFFFFFFu;
constexpr std::uint32_t coarse = 32;  ///< of a stretch every so many spheres are looked at first
constexpr std::uint32_t around = 20;  ///< spheres to either side that are then compared
constexpr std::uint32_t along = 4;    ///< spheres that follow a middle one

float square(const Sphere& a, const Sphere& b) {
  const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace

std::optional<Pair> CoarseLook::look_near(const ChainView& chain, const SphereRange& queries,
                                          const Pair& pair) {
  const auto range = [&](std::uint32_t i) {
    return SphereRange{i - std::min(i, around), std::min(chain.size, i + around)};
  };
  const SphereRange a = range(pair.i), b = range(pair.j);
  for (std::uint32_t i = a.begin; i < a.end; ++i)
    for (std::uint32_t j = std::max(b.begin, i + 1); j < b.end; ++j)
      if (queries.contains(i) && Robust::overlap(chain.spheres[i], chain.spheres[j]) &&
          !chain.neighbours(i, j))
        return Pair{i, j};
  return std::nullopt;
}

std::optional<Pair> CoarseLook::look_along(const ChainView& chain, const SphereRange& queries,
                                           std::uint32_t i) {
  for (std::uint32_t j = i + 1; j < std::min(chain.size, i + along); ++j)
    if (queries.contains(i) && Robust::overlap(chain.spheres[i], chain.spheres[j]) && !chain.neighbours(i, j))
      return Pair{i, j};
  return std::nullopt;
}

std::optional<Pair> CoarseLook::compare(const ChainView& chain, const SphereRange& queries, std::uint32_t a,
                                        std::uint32_t b) {
  float least = std::numeric_limits<float>::infinity();
  Pair nearest{a * stretch, b * stretch};
  for (std::uint32_t i = a * stretch; i < (a + 1) * stretch; i += coarse)
    for (std::uint32_t j = b * stretch; j < (b + 1) * stretch; j += coarse)
      if (const float q = square(chain.spheres[i], chain.spheres[j]); q < least) least = q, nearest = {i, j};
  return look_near(chain, queries, nearest);
}

void CoarseLook::lay_out(const ChainView& chain) {
  stretches_.resize(chain.size / stretch);
  const auto middle = [&](std::size_t k) -> const Sphere& {
    return chain.spheres[k * stretch + stretch / 2];
  };
  double sum = 0;
  constexpr std::size_t ahead = 16;  // each is in a part of memory of its own
  for (std::size_t k = 0; k < stretches_.size(); ++k) {
    if (k + ahead < stretches_.size()) prefetch(&middle(k + ahead));
    const Sphere &own = middle(k), &before = middle(k - (k > 0)),
                 &next = middle(k + (k + 1 < stretches_.size()));
    const float reach = std::sqrt(std::max(square(own, before), square(own, next))) / 2 + own.radius;
    stretches_[k] = {own.x, own.y, own.z, reach, {}, nothing};
    sum += reach;
  }
  // As wide as two usual stretches reach; a longer one is found less often, which is no fault of the answer.
  const double width = 2 * sum / static_cast<double>(stretches_.size());
  const double scale = width > 0 && std::isfinite(width) ? 1 / width : 0;
  const auto cell = [scale](float at) {
    return static_cast<std::int32_t>(std::clamp(std::floor(at * scale), -1e9, 1e9));
  };
  for (Stretch& s : stretches_) s.cell[0] = cell(s.x), s.cell[1] = cell(s.y), s.cell[2] = cell(s.z);
  buckets_.assign(std::bit_ceil(2 * stretches_.size()), nothing);
}

std::uint32_t CoarseLook::bucket(std::uint32_t mixed) const {
  return (mixed ^ mixed >> 15) & static_cast<std::uint32_t>(buckets_.size() - 1);
}

std::optional<Pair> CoarseLook::look(const ChainView& chain, const SphereRange& queries) {
  compared_ = 0;
  if (!pays(chain.size)) return std::nullopt;
  lay_out(chain);
  const auto most = static_cast<std::uint32_t>(stretches_.size() / 16) + 32;
  std::uint64_t left = std::uint64_t{64} * stretches_.size();  // visits, where lists grow long
  for (std::uint32_t k = 0; k < stretches_.size(); ++k) {
    if (const auto pair = look_along(chain, queries, k * stretch + stretch / 2)) return pair;
    Stretch& own = stretches_[k];
    // A hash of a cell is one of its three numbers each, so that those of the cells around it take three
    // more.
    const auto part = [](std::int32_t cell, std::uint32_t factor) {
      const std::uint32_t here = static_cast<std::uint32_t>(cell) * factor;
      return std::array{here, here - factor, here + factor};
    };
    const auto in_x = part(own.cell[0], 0x9E3779B1u), in_y = part(own.cell[1], 0x85EBCA77u),
               in_z = part(own.cell[2], 0xC2B2AE3Du);
    std::array<std::uint32_t, 27> hashes;
    for (std::size_t d = 0; d < 27; ++d) hashes[d] = in_x[d % 3] ^ in_y[d / 3 % 3] ^ in_z[d / 9];
    for (const std::uint32_t hash : hashes) {
      for (std::uint32_t e = buckets_[bucket(hash)]; e != nothing; e = stretches_[e].next) {
        if (left-- == 0) return std::nullopt;
        const Stretch& other = stretches_[e];
        const float dx = own.x - other.x, dy = own.y - other.y, dz = own.z - other.z;
        const float reach = own.reach + other.reach;
        if (e + 1 >= k || dx * dx + dy * dy + dz * dz > reach * reach) continue;
        if (compared_++ == most) return std::nullopt;
        if (const auto pair = compare(chain, queries, e, k)) return pair;
      }
    }
    std::uint32_t& head = buckets_[bucket(hashes[0])];
    own.next = head, head = k;
  }
  return std::nullopt;
}

}  // namespace catena
