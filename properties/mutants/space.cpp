#include <algorithm>
#include <limits>

#include "catena/properties/mutants/faulty_hybrid.h"

// Bugs of a search by blocks in the order of space.
namespace catena::properties {
namespace {

class FaultySpace : public FaultyHybrid {
  void tamper(const ChainView&, Parts& parts) override {
    if (parts.space.entries > 0) tamper(parts.space);
  }
  virtual void tamper(SpaceTree& space) = 0;
};

constexpr std::uint32_t group = SpaceTree::group;

/// Where nothing is.
void lose(SpaceTree& space, std::size_t level, std::uint32_t k) {
  float* const box = space.boxes_of(level, k / group) + k % group;
  for (std::uint32_t d = 0; d < 3; ++d) box[d * group] = std::numeric_limits<float>::infinity();
}

class BoxOfCentres final : public FaultySpace {
  void tamper(SpaceTree& space) override {
    for (std::uint32_t k = 0; k < space.entries; ++k) {
      float* const box = space.boxes_of(0, k / group) + k % group;
      for (std::uint32_t d = 0; d < 3; ++d) {
        float &low = box[d * group], &high = box[(3 + d) * group];
        const float eighth = (high - low) / 8;
        low += eighth, high -= eighth;
      }
    }
  }
};
const RegisterMutant<BoxOfCentres> box_of_centres{"space-box-too-small",
                                                  "boxes that leave the thickness out"};

class LastEntryLost final : public FaultySpace {
  void tamper(SpaceTree& space) override { lose(space, 0, space.entries - 1); }
};
const RegisterMutant<LastEntryLost> last_entry{"last-block-not-sorted",
                                               "a sort that is handed one block too few"};

class LastRowLost final : public FaultySpace {
  void tamper(SpaceTree& space) override {
    if (space.boxes.size() > 1) lose(space, 1, space.nodes() - 1);
  }
};
const RegisterMutant<LastRowLost> last_row{"space-drops-its-last-row",
                                           "sixteen at a time, and the last that are there forgotten"};

/// Some blocks are taken to be dense, and the search by spheres was not told.
class DenseWithoutGrid final : public FaultySpace {
  void tamper(SpaceTree& space) override {
    std::fill(space.dense_entry.begin(), space.dense_entry.end(), std::uint8_t{1});
  }
};
const RegisterMutant<DenseWithoutGrid> dense_alone{"dense-left-alone",
                                                   "each of two searches leaves a pair to the other"};

}  // namespace
}  // namespace catena::properties
