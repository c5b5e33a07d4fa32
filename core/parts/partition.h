#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/executor/team.h"
#include "catena/core/parameters/parameters.h"

namespace catena::parts {

/// How the groups of a chain are shared out.
enum class Order {
  measured,  ///< by space where halos in chain order have more than an eighth of the chain, and fewer so
  chain,
  space
};

/// A chain parted for searches of one part at a time: each part has some of the chain's groups of consecutive
/// spheres, and a halo, the groups of others that may touch one of its own. So a part and its halo have every
/// pair of a sphere of the part.
class Partition {
 public:
  struct Options {
    std::uint32_t group =
        32;  ///< spheres of a group in chain order, >= 1; an eighth of that, at least 1, by space
    Order order = Order::measured;
  };

  /// Parts the chain into `parts` of about as many groups each, >= 1; by space some may be empty. In chain
  /// order O(n), and O(m log n) for m groups near another part; by space O(n parts). Shared out by the team.
  Partition(const Chain& chain, std::uint32_t parts, const Options& options, const Team& team);

  std::uint32_t size() const { return static_cast<std::uint32_t>(parts_.size()); }
  bool in_space() const { return in_space_; }
  std::uint32_t group() const { return group_; }  ///< spheres of a group
  /// A part's own groups, ascending.
  std::span<const std::uint32_t> own(std::uint32_t part) const { return parts_[part].own; }
  /// Its halo: of parts before it, ascending, then of those after it, ascending.
  std::span<const std::uint32_t> halo_before(std::uint32_t part) const { return parts_[part].before; }
  std::span<const std::uint32_t> halo_after(std::uint32_t part) const { return parts_[part].after; }
  /// The greatest number of spheres in a part and its halo.
  std::uint64_t greatest() const;

 private:
  struct Part {
    std::vector<std::uint32_t> own, before, after;
  };
  double part_in_chain_order(const Chain& chain, std::uint32_t parts, const Options& options,
                             const Team& team);
  void part_by_space(const Chain& chain, std::uint32_t parts, const Options& options, const Team& team);
  double halo_share() const;

  std::uint32_t group_ = 1;
  bool in_space_ = false;
  std::vector<Part> parts_;
};

/// As a strategy's parameters `group` and `order` say.
Partition::Options partition_options(const Parameters& parameters);

}  // namespace catena::parts
