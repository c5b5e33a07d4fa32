#pragma once
#include <cstddef>
#include <vector>

#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/host_warp.h"

namespace catena {

/// BlockNodes on the host, its boxes fitted one after the other: the device's twin. Keeps its memory.
class HostBlockNodes {
 public:
  /// Over blocks whose capsules are known, of which there is one.
  const BlockNodes& fit(const CapsuleBlocks& blocks, std::uint32_t at_top = BlockNodes::most_at_top) {
    nodes_ = BlockNodes::over(blocks.blocks, at_top);
    quarter_.resize(BlockNodes::quarters * std::size_t{nodes_.nodes()});
    nodes_.quarter = quarter_.data();
    const NodeMeeting meeting(nodes_, blocks);
    for (std::uint32_t level = 1; level <= nodes_.top; ++level)
      for (std::uint32_t k = 0; k < nodes_.count[level]; ++k)
        nodes_.put(level, k, meeting.fit(HostOctet(), level, k));
    return nodes_;
  }
  const BlockNodes& nodes() const { return nodes_; }

 private:
  BlockNodes nodes_{};
  std::vector<BlockNodes::Quarter> quarter_;
};

}  // namespace catena
