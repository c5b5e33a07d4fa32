#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"

namespace catena {

/// A look at some blocks of eight spheres before any tree is built.
class CATENA_API CrowdLook {
 public:
  /// In each part of the chain blocks meet more than so many others, on average: then no order of blocks will
  /// do, and single spheres may be searched at once. Told by as many blocks as need be to see some of them
  /// meet, the square root of all, about; and where it is not clear, false, as where they meet fewer by so
  /// many standard deviations.
  bool everywhere(const ChainView& chain, double others, double deviations);

 private:
  std::vector<float> capsules_;
  std::vector<std::uint32_t> times_;
};

}  // namespace catena
