#pragma once
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/core/input/input.h"

namespace catena::ranks {

/// The first frame of a scene or file, for tests.
inline Chain chain_of(const std::string& spec, const InputOptions& options = {}) {
  return open_input(spec, options).animation->frame(0);
}

}  // namespace catena::ranks
