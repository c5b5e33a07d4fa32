#pragma once
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/lone_spheres/lone_cells.h"
#include "catena/core/lone_spheres/lone_map.h"
#include "catena/core/space_tree/crowd_look.h"

namespace catena {

/// Tells spheres that nothing can touch from the others before anything is sorted: for chains that jump
/// everywhere and have little near them.
class CATENA_API LoneSpheres {
 public:
  /// Whether leaving them out pays, by a look at some: eight, where these have their next ones near, as in
  /// most chains; else about the square root of all. Not where the chain's own order tells what is near.
  bool pay(const ChainView& chain, const LoneCells& cells);

  /// The indices of all spheres that are not alone, and of a few that are, ascending; the same for any team.
  /// O(n); does not allocate when n has not grown.
  void leave_out(const ChainView& chain, const LoneCells& cells, LargeVector<std::uint32_t>& others,
                 const Team& team);

 private:
  void take_sample(const ChainView& chain, double times);
  std::uint64_t pairs_near(const ChainView& chain, float far, double times);
  double met_by_each(const ChainView& chain, const LoneCells& cells, double times);

  LoneMap map_;
  CrowdLook look_;
  std::vector<Sphere> sample_;
  std::vector<float> fields_;  ///< of the sample
  LargeVector<std::uint32_t> met_;
  std::vector<std::uint32_t> left_;  ///< [part of the chain]: others in it
};

}  // namespace catena
