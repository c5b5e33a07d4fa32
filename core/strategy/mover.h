#pragma once
#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/sphere.h"

namespace catena {

/// Moves chains and hierarchies between host and device. Implemented where the device is (cuda/) and
/// registered with the strategies; owns the buffers that its views point into and reuses them. Views stay
/// valid until the next call of the same function. Every call returns when the data has arrived.
class CATENA_API Mover {
 public:
  virtual ~Mover() = default;
  virtual ChainView to_device(const ChainView& host) = 0;
  virtual HierarchyView<Sphere> to_device(const HierarchyView<Sphere>& host) = 0;
  virtual HierarchyView<Sphere64> to_device(const HierarchyView<Sphere64>& host) = 0;
  virtual HierarchyView<Sphere> to_host(const HierarchyView<Sphere>& device) = 0;
  virtual HierarchyView<Sphere64> to_host(const HierarchyView<Sphere64>& device) = 0;
  /// Fills the device's cache with other data, so that the next stage starts cold; for measurements.
  virtual void flush_cache() = 0;
};

}  // namespace catena
