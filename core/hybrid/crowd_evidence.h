#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/blocks/block_evidence.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/space_tree/space_evidence.h"

namespace catena {

/// The nodes of a BlockTree of which some are crowded, as evidence names them: what is crowded below a node
/// is a node of its own, for pairs of it are other searches' (NodeParts). Blocks and nodes of level 0 are
/// crowded or not.
class CrowdNodes {
 public:
  /// All must outlive this. Ids are those of BlockEvidence, and what follows them.
  CrowdNodes(const ChainView& chain, const BlockTree& tree, const Crowding& crowding);

  std::uint32_t end_id() const { return end_id_; }
  bool is_sphere(std::uint32_t id) const { return id < chain_.size; }
  bool crowded(std::uint32_t sphere) const { return parts_[sphere].ours == NodeParts::none; }
  /// Of a node or sphere that BlockEvidence names.
  const NodeParts& parts(std::uint32_t id) const { return parts_[id]; }
  void show(BoundsVisitor& visitor) const;

 private:
  const ChainView& chain_;
  const BlockTree& tree_;
  std::vector<NodeParts> parts_;  ///< [id]
  std::uint32_t end_id_;
};

/// Between a BlockEvidence of a search of what is not crowded and the sink: puts parts in place of nodes, and
/// lets no pair pass that other searches account for.
class CrowdSink final : public EvidenceSink {
 public:
  /// All must outlive this. `space` has ended, or is null where no block is sorted in space.
  CrowdSink(const CrowdNodes& nodes, const SpaceEvidence* space, EvidenceSink& sink)
      : nodes_(nodes), space_(space), sink_(sink) {}

  void discarded(std::uint32_t a, std::uint32_t b) override;
  void tested(std::uint32_t i, std::uint32_t j) override {
    if (!another_has(i, j)) sink_.tested(i, j);
  }
  void excluded(std::uint32_t i, std::uint32_t j) override {
    if (!another_has(i, j)) sink_.excluded(i, j);
  }
  void compared(std::uint32_t a, std::uint32_t b) override;

 private:
  bool another_has(std::uint32_t i, std::uint32_t j) const {
    return nodes_.crowded(i) && nodes_.crowded(j) &&
           !(space_ != nullptr && space_->were_left_to_blocks(i, j));
  }

  const CrowdNodes& nodes_;
  const SpaceEvidence* const space_;
  EvidenceSink& sink_;
};

}  // namespace catena
