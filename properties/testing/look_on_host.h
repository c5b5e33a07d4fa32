#pragma once
#include "catena/core/cells/capsule_blocks.h"

namespace catena::properties {

/// What a first look at a chain's blocks sees, and what is said by it in place of the survey.
struct LookOnHost {
  CapsuleBlocks::Look saw;
  CapsuleBlocks::Survey said;
};
/// On the host; in a file of its own as a compiler of device code warns of what runs there alone.
LookOnHost look_on_host(const ChainView& chain, const CapsuleBlocks& laid_out);

}  // namespace catena::properties
