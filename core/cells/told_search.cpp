#include "catena/core/cells/told_search.h"

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/arithmetic/robust.h"
#include "catena/core/cells/host_comparison.h"

namespace catena {
namespace {

struct TellingBlocks : LaneSink {
  CapsuleEvidence& evidence;
  void met(std::uint32_t a, std::uint32_t near_a, std::uint32_t b, std::uint32_t near_b) {
    evidence.met(a, near_a, b, near_b);
  }
  void compared(std::uint32_t i, std::uint32_t j) { evidence.compared(i, j); }
};
struct TellingCells : LaneSink {
  CellsEvidence& evidence;
  void looks(std::uint32_t i, std::uint32_t level, std::uint32_t cells) { evidence.looks(i, level, cells); }
  void compared(std::uint32_t i, std::uint32_t j, std::uint32_t level) { evidence.compared(i, j, level); }
};

}  // namespace

ToldCells::ToldCells(const ChainView& chain, const CapsuleBlocks* blocks, const PlacedCells& cells)
    : chain_(chain), blocks_(blocks), cells_(cells) {
  std::uint32_t next = chain.size;
  if (blocks != nullptr && !blocks->all_crowded) next = block_nodes_.emplace(chain, *blocks, next).end_id();
  trees_.emplace(cells.trees(chain, next));
}

void ToldCells::show(BoundsVisitor& visitor) const {
  if (block_nodes_) block_nodes_->show(visitor);
  trees_->show(visitor);
}

void ToldCells::search(PairCollector::Lane& lane, EvidenceSink& to) const {
  with_tests_for<Robust>(chain_, [&](auto tests) {
    using Tests = decltype(tests);
    if (block_nodes_) {
      CapsuleEvidence evidence(chain_, *blocks_, *block_nodes_, to);
      TellingBlocks sink{{lane}, evidence};
      compare_blocks<Tests>(chain_, *blocks_, sink);
      evidence.rest();
    }
    CellsEvidence evidence(chain_, *trees_, to);
    TellingCells sink{{lane}, evidence};
    cells_.search<Tests>(chain_, sink);
    evidence.rest();
  });
}

ToldTree::ToldTree(const ChainView& chain, const CapsuleBlocks& blocks, const BlockNodes& nodes)
    : chain_(chain), blocks_(blocks), nodes_(nodes), shown_(chain, blocks, chain.size) {}

void ToldTree::show(BoundsVisitor& visitor) const { shown_.show(visitor); }

void ToldTree::search(PairCollector::Lane& lane, EvidenceSink& to) const {
  with_tests_for<Robust>(chain_, [&](auto tests) {
    CapsuleEvidence evidence(chain_, blocks_, shown_, to);
    TellingBlocks sink{{lane}, evidence};
    compare_blocks_in_tree<decltype(tests)>(chain_, nodes_, blocks_, sink);
    evidence.rest();
  });
}

}  // namespace catena
