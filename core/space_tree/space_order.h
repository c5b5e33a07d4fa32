#pragma once
#include <cstdint>
#include <memory>
#include <span>

#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"

namespace catena {

struct SpaceRows;

/// Boxes, `stride` floats from one's lows x y z to the next one's; the highs follow the lows.
struct BoxRows {
  const float* first;
  std::size_t stride;
  std::uint32_t size;
};

/// When a tree in space is built of what the last one was built of, moved: whether it is sorted anew, or only
/// where the order of the last one does not serve any more.
enum class SpaceSort { anew, where_needed };

/// Sorts boxes or spheres in space: by class of size, a factor of 8 each and the greatest first, and in a
/// class along Hilbert's curve through the cubes of the box of their middles, 512 a side, and of cubes with
/// many of them. Equal ones keep their order. The same for any team.
class CATENA_API SpaceOrder {
 public:
  SpaceOrder();
  ~SpaceOrder();
  SpaceOrder(SpaceOrder&&) noexcept;
  SpaceOrder& operator=(SpaceOrder&&) noexcept;

  /// O(n log n); does not allocate when n has not grown, in a team of one.
  void sort(const BoxRows& boxes, const Team& team);
  /// Spheres of a chain, or `only` those of these indices, by their centres and radii.
  void sort(const ChainView& chain, std::span<const std::uint32_t> only, const Team& team);
  /// The number of the box, or the index of the sphere, that comes to this place.
  std::uint32_t operator[](std::size_t place) const { return static_cast<std::uint32_t>(entries_[place]); }

 private:
  struct Sort;
  void sort(const SpaceRows& rows, std::size_t n, std::span<const std::uint32_t> only, const Team& team);

  std::unique_ptr<Sort> sort_;
  const std::uint64_t* entries_ = nullptr;  // the sort's
};

}  // namespace catena
