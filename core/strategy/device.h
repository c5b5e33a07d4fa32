#pragma once
#include <functional>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/sphere.h"
#include "catena/core/strategy/moved.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/resident.h"

namespace catena {

/// What the host needs of one device: chains and trees moved, work run and timed, answers fetched.
/// Implemented where the device is (cuda/) and registered with the strategies; owns the buffers that its
/// views point into and reuses them. Views stay valid until the next call of the same function. Every call
/// returns when it is done.
class CATENA_API Device {
 public:
  using Work = std::function<void(StreamHandle)>;
  using Search = std::function<void(const ResidentAnswer&, StreamHandle)>;
  struct Times {
    double work_ms = 0;      ///< kernels, by the device's clock
    double transfer_ms = 0;  ///< answers to the host, wall time
    double start_ms = 0;     ///< of work whose code had to be loaded first, wall time
  };

  virtual ~Device() = default;
  /// What chains have in common (strands, neighbours) is moved once, not for every frame. `moved`: where the
  /// chain differs from the one before it, of as many spheres; only that much is moved, then.
  virtual ChainView to_device(const ChainView& host, const Moved& moved = {}) = 0;
  virtual HierarchyView<Sphere> to_device(const HierarchyView<Sphere>& host) = 0;
  virtual HierarchyView<Sphere64> to_device(const HierarchyView<Sphere64>& host) = 0;
  virtual HierarchyView<Sphere> to_host(const HierarchyView<Sphere>& device) = 0;
  virtual HierarchyView<Sphere64> to_host(const HierarchyView<Sphere64>& device) = 0;

  /// Runs what `work` enqueues on the stream that it is given; once more, for its time, where its code had to
  /// be loaded first and that took longer.
  virtual Times run(const Work& work) = 0;
  /// Enqueues what every search begins with: counts, if wanted, and state of an answer for n spheres set to
  /// nothing.
  virtual void clear(const ResidentAnswer& answer, std::uint32_t n, StreamHandle stream) = 0;
  /// Runs what `search` enqueues for a chain of n spheres into an answer that was cleared, again with more
  /// room until nothing is lost, and brings the answer to the host. Throws PairLimitExceeded with the true
  /// number. `mend` is told of every overflow.
  virtual Times answer(std::uint32_t n, const Request& request, Collisions& result, const Search& search,
                       const std::function<void(const ResidentState&)>& mend) = 0;
  /// The same, of work that is run once before, so that it has its memory, and then recorded: `work_ms` is
  /// what one launch of that graph takes, which comes right after `before`.
  virtual Times answer_by_graph(std::uint32_t n, const Request& request, Collisions& result,
                                const Search& search, const std::function<void(const ResidentState&)>& mend,
                                const std::function<void()>& before) = 0;
  /// Fills the device's cache with other data, so that the next stage starts cold; for measurements.
  virtual void flush_cache() = 0;
};

/// A tree that can be moved between the host and a device, so that its two stages may live apart.
template <class Tree>
concept Movable = requires(Device& device, const Tree& tree) {
  {device.to_device(tree)};
  {device.to_host(tree)};
};

}  // namespace catena
