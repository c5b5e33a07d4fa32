#pragma once
#include <optional>

#include "catena/core/cells/blocks_evidence.h"
#include "catena/core/cells/cells_evidence.h"
#include "catena/core/cells/host_sphere_cells.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/export.h"

namespace catena {

/// What blocks and cells that lie in host memory, and whose builds are done, say of a search: their nodes,
/// and by the device's own policies what it does. A device's are copied to the host for that.
class CATENA_API ToldSearch {
 public:
  /// All must outlive this; without blocks all spheres are in the cells.
  ToldSearch(const ChainView& chain, const CapsuleBlocks* blocks, const PlacedCells& cells);

  void show(BoundsVisitor& visitor) const;
  /// In robust arithmetic.
  void search(PairCollector::Lane& lane, EvidenceSink& to) const;

 private:
  const ChainView& chain_;
  const CapsuleBlocks* const blocks_;
  const PlacedCells& cells_;
  std::optional<CapsuleNodes> block_nodes_;
  std::optional<CellsTrees> trees_;
};

}  // namespace catena
