#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/device.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/strand_table.h"

namespace catena {

/// How a chain comes to a device, frame after frame: only what does not lie there, unless it is told to move
/// all, and without a strand table where it needs none (StrandTable).
class CATENA_API Upload {
 public:
  Upload() = default;
  explicit Upload(const Parameters& parameters);

  /// As Device::to_device. What it throws leaves nothing there that is known.
  ChainView run(Device& device, const ChainView& chain, const Moved& moved);

  /// Of the last run.
  Plan told() const;

 private:
  StrandTable strands_;
  bool all_ = false;
  std::uint64_t topology_ = 0;  ///< of the chain that lies there; 0: none, or unknown
  std::uint32_t spheres_ = 0;   ///< of the last run
  std::uint32_t moved_ = 0;     ///< of these
  bool known_ = false;          ///< strands and neighbours lay there
};

/// A strategy's parameters with "upload", changed or all, and that of StrandTable.
CATENA_API std::vector<ParameterInfo> with_upload(std::vector<ParameterInfo> own);

}  // namespace catena
