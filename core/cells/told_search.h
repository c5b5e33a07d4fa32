#pragma once
#include <optional>

#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/blocks_evidence.h"
#include "catena/core/cells/cells_evidence.h"
#include "catena/core/cells/host_sphere_cells.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/export.h"

namespace catena {

/// What parts that lie in host memory, and whose builds are done, say of a search: their nodes, and by the
/// device's own policies what it does. A device's are copied to the host for that.
class CATENA_API ToldSearch {
 public:
  virtual ~ToldSearch() = default;
  virtual void show(BoundsVisitor& visitor) const = 0;
  /// In robust arithmetic.
  virtual void search(PairCollector::Lane& lane, EvidenceSink& to) const = 0;
};

/// Of blocks and, for the crowded ones, cells.
class CATENA_API ToldCells final : public ToldSearch {
 public:
  /// All must outlive this; without blocks all spheres are in the cells.
  ToldCells(const ChainView& chain, const CapsuleBlocks* blocks, const PlacedCells& cells);

  void show(BoundsVisitor& visitor) const override;
  void search(PairCollector::Lane& lane, EvidenceSink& to) const override;

 private:
  const ChainView& chain_;
  const CapsuleBlocks* const blocks_;
  const PlacedCells& cells_;
  std::optional<CapsuleNodes> block_nodes_;
  std::optional<CellsTrees> trees_;
};

/// Of blocks that only their tree is asked about.
class CATENA_API ToldTree final : public ToldSearch {
 public:
  /// All must outlive this.
  ToldTree(const ChainView& chain, const CapsuleBlocks& blocks, const BlockNodes& nodes);

  void show(BoundsVisitor& visitor) const override;
  void search(PairCollector::Lane& lane, EvidenceSink& to) const override;

 private:
  const ChainView& chain_;
  const CapsuleBlocks& blocks_;
  const BlockNodes& nodes_;
  const CapsuleNodes shown_;
};

}  // namespace catena
