#include "catena/properties/testing/look_on_host.h"

#include "catena/core/cells/host_blocks.h"

namespace catena::properties {

LookOnHost look_on_host(const ChainView& chain, const CapsuleBlocks& laid_out) {
  HostBlocks host;
  const CapsuleBlocks& blocks = host.enclose(chain, laid_out);
  return {*blocks.look, CapsuleBlocks::Survey::of(blocks.state->survey)};
}

}  // namespace catena::properties
