#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/parts/order.h"
#include "catena/core/parts/part_ranges.h"

namespace catena::parts {

/// How a chain is cut into parts.
struct PartitionOptions {
  /// Consecutive spheres that stay together, >= 1; by space an eighth of that, at least 1.
  std::uint32_t group = 32;
  Order order = Order::measured;  ///< by space only where halos are smaller so
};
/// As a strategy's parameters `group` and `order` say.
PartitionOptions partition_options(const Parameters& parameters);

/// A chain parted for searches of one part at a time. Each sphere is a part's own once, so that the parts and
/// their halos have each pair of the chain in a part of which a sphere of it is.
struct CATENA_API Partition {
  std::vector<PartRanges> parts;
  bool in_space = false;

  /// The greatest number of spheres in a part and its halo.
  std::uint64_t greatest() const;
  /// Spheres in all halos, as a share of all.
  double halo_share() const;
};

/// Consecutive parts of about as many groups each, >= 1, without halos. O(parts).
Partition cut_in_chain_order(std::uint32_t spheres, std::uint32_t parts, std::uint32_t group);

/// Parts the chain into `parts` >= 1; by space some may be empty. In chain order O(n), and O(m log n) for m
/// groups near another part; by space O(n log parts). Shared out by the team.
CATENA_API Partition part_chain(const Chain& chain, std::uint32_t parts, const PartitionOptions& options,
                                const Team& team);

/// Whether chain order seems to tangle the parts, so that halos would be large: by a few groups of the
/// chain. Only a guess.
bool seems_tangled(const Chain& chain, std::uint32_t parts, std::uint32_t group, const Team& team);

}  // namespace catena::parts
