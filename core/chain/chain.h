#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/chain/exclusion.h"
#include "catena/core/export.h"
#include "catena/core/sphere.h"

namespace catena {

/// How the spheres divide into strands (consecutive runs), each open or closed.
struct CATENA_API Strands {
  std::vector<std::uint32_t>
      first;  ///< strands + 1 ascending offsets, from 0 to n; empty means one open strand
  std::vector<std::uint8_t>
      closed;  ///< one flag a strand: the last sphere is joined to the first; empty: all open

  static Strands one_closed(std::uint32_t n) { return {{0, n}, {1}}; }
};

/// A tube as spheres in order along it. Immutable: what is checked when it is made stays true.
class CATENA_API Chain {
 public:
  Chain() : Chain(std::vector<Sphere>{}) {}

  /// Throws InputError, naming the sphere, strand or pair, unless: every number is finite, every radius >= 0,
  /// n < 2^31, offsets ascend from 0 to n, window >= 1, the arc factor is finite and > 0, extra pairs are two
  /// different spheres of the chain. Cost O(n + p log p) for p extra pairs.
  explicit Chain(std::vector<Sphere> spheres, Strands strands = {}, Exclusion exclusion = {});

  /// The same chain with its spheres moved: strands and neighbours stay, the arc lengths of an arc window
  /// too. Throws InputError when the number of spheres differs or a sphere is not valid.
  Chain moved(std::vector<Sphere> spheres) const;

  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(spheres_.size()); }
  std::span<const Sphere> spheres() const noexcept { return spheres_; }
  const Sphere& operator[](std::uint32_t i) const { return spheres_[i]; }

  std::uint32_t strand_count() const noexcept {
    return static_cast<std::uint32_t>(strands_.first.size() - 1);
  }
  const Strands& strands() const noexcept { return strands_; }
  const Exclusion& exclusion() const noexcept { return exclusion_; }  ///< extra pairs sorted, unique, i < j

  bool neighbours(std::uint32_t i, std::uint32_t j) const { return view().neighbours(i, j); }

  /// Plain pointers into this chain, valid while it lives.
  ChainView view() const noexcept;

 private:
  void check_spheres();
  void check_strands();
  void check_exclusion();
  void index_strands();
  void index_extra_pairs();
  void measure_arcs();

  std::vector<Sphere> spheres_;
  Extent extent_{};
  Strands strands_;
  Exclusion exclusion_;
  std::vector<std::uint32_t> strand_of_, extra_row_, extra_;
  std::vector<double> arc_, loop_length_;
};

}  // namespace catena
