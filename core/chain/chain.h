#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/chain/topology.h"
#include "catena/core/export.h"
#include "catena/core/sphere.h"

namespace catena {

/// A tube as spheres in order along it. Immutable: what is checked when it is made stays true. One that was
/// moved from or released can be assigned to and destroyed, and nothing else.
class CATENA_API Chain {
 public:
  /// Of no spheres. Only the first one of a program allocates.
  Chain();

  /// Throws InputError, naming the sphere, strand or pair, unless: every number is finite, every radius >= 0,
  /// n < 2^31, offsets ascend from 0 to n, window >= 1, the arc factor is finite and > 0, extra pairs are two
  /// different spheres of the chain, and fewer than 2^31. Cost O(n + p log p) for p extra pairs.
  explicit Chain(std::vector<Sphere> spheres, Strands strands = {}, Exclusion exclusion = {});

  /// A part of a longer chain, under an arc window whose arc lengths are those of the whole: one a sphere and
  /// one a strand, which are taken as they are. Throws InputError also when there are not as many, one is not
  /// finite, or they fall along a strand.
  Chain(std::vector<Sphere> spheres, Strands strands, Exclusion exclusion, ArcLengths arcs);

  /// The same chain with its spheres moved: strands and neighbours stay, the arc lengths of an arc window
  /// too; they are shared, not copied. O(n). Throws InputError when the number of spheres differs or a sphere
  /// is not valid.
  Chain moved(std::vector<Sphere> spheres) const;

  /// The spheres of a chain that is not needed any more, so that their memory may serve the next frame's.
  std::vector<Sphere> release() && { return std::move(spheres_); }

  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(spheres_.size()); }
  std::span<const Sphere> spheres() const noexcept { return spheres_; }
  const Sphere& operator[](std::uint32_t i) const { return spheres_[i]; }

  std::uint32_t strand_count() const noexcept {
    return static_cast<std::uint32_t>(topology_->strands.first.size() - 1);
  }
  const Strands& strands() const noexcept { return topology_->strands; }
  const Exclusion& exclusion() const noexcept { return topology_->exclusion; }

  bool neighbours(std::uint32_t i, std::uint32_t j) const { return view().neighbours(i, j); }

  /// Plain pointers into this chain, valid while it lives.
  ChainView view() const noexcept;

 private:
  Chain(std::vector<Sphere> spheres, std::shared_ptr<const Topology> topology);
  void check_spheres();
  void tell_reach();

  std::vector<Sphere> spheres_;
  Extent extent_{};
  NeighbourReach reach_{};
  std::shared_ptr<const Topology> topology_;
};

}  // namespace catena
