#include <algorithm>
#include <limits>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/space_tree/space_kernels.h"
#include "catena/properties/mutants/mutant.h"

// Bugs of a search by blocks in the order of space.
namespace catena::properties {
namespace {

/// All blocks in the order of space, tampered with.
class FaultySpace : public HostSearch {
  void construct(const ChainView& chain) override {
    build_block_tree(chain, tree_, team());
    find_crowds(chain, tree_, 0, crowding_, team());
    space_.entries = 0;
    if (crowding_.crowded_nodes() == 0) return;
    build_space_tree(chain, tree_, crowding_, space_, 1e6, {&entry_queue_, 1}, team());
    if (space_.entries == 0) throw std::runtime_error("the chain jumps everywhere");
    tamper(tree_, space_);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    search_uncrowded(chain, tree_, crowding_, {&block_queues_, 1}, collector, team());
    if (space_.entries > 0)
      search_space_tree(chain, tree_, space_, {&entry_queue_, 1}, {&block_queues_, 1}, collector, team());
  }
  virtual void tamper(BlockTree& tree, SpaceTree& space) = 0;

  BlockTree tree_;
  Crowding crowding_;
  SpaceTree space_;
  SpaceQueue entry_queue_;
  BlockQueues block_queues_;
};

class BoxOfCentres final : public FaultySpace {
  void tamper(BlockTree&, SpaceTree& space) override {
    for (std::uint32_t k = 0; k < space.entries; ++k) {
      float* const box = space.boxes_of(0, k / SpaceTree::group) + k % SpaceTree::group;
      for (std::uint32_t d = 0; d < 3; ++d) {
        float &low = box[d * SpaceTree::group], &high = box[(3 + d) * SpaceTree::group];
        const float eighth = (high - low) / 8;
        low += eighth, high -= eighth;
      }
    }
  }
};
const RegisterMutant<BoxOfCentres> box_of_centres{"space-box-too-small",
                                                  "boxes that leave the thickness out"};

class LastEntryLost final : public FaultySpace {
  void tamper(BlockTree&, SpaceTree& space) override {
    const std::uint32_t k = space.entries - 1;
    float* const box = space.boxes_of(0, k / SpaceTree::group) + k % SpaceTree::group;
    for (std::uint32_t d = 0; d < 3; ++d) box[d * SpaceTree::group] = std::numeric_limits<float>::infinity();
  }
};
const RegisterMutant<LastEntryLost> last_entry{"last-block-not-sorted",
                                               "a sort that is handed one block too few"};

/// Some blocks are taken to be dense, and the search by spheres was not told.
class DenseWithoutGrid final : public FaultySpace {
  void tamper(BlockTree&, SpaceTree& space) override {
    std::fill(space.dense_entry.begin(), space.dense_entry.end(), std::uint8_t{1});
  }
};
const RegisterMutant<DenseWithoutGrid> dense_alone{"dense-left-alone",
                                                   "each of two searches leaves a pair to the other"};

}  // namespace
}  // namespace catena::properties
