#include <algorithm>
#include <array>
#include <cstring>

#include "catena/core/hierarchy/box.h"
#include "catena/core/ranks/bytes.h"
#include "catena/properties/mutants/faulty_ranks.h"
#include "catena/properties/mutants/mutant.h"

// Bugs of searches by ranks: what one tells of where it is is too little, what it asks for is short or comes
// twice, what moves to another rank arrives wrong.
namespace catena::properties {
namespace {

using ranks::ByteReader;
using ranks::Bytes;
using ranks::Phase;

/// The exchange begins with tops of all that each rank holds, then of what is near others; both begin with
/// one box around all.
template <unsigned which>
class TopsLeftOut final : public FaultyRanks {
  void spoil_gathered(Phase phase, unsigned time, Bytes& bytes) const override {
    if (phase == Phase::across && time == which && bytes.size() > 2 * sizeof(Box))
      bytes.resize(2 * sizeof(Box));
  }
};
const RegisterMutant<TopsLeftOut<1>> of_all{
    "tops-of-a-rank-left-out", "a loop over tops that ends after the first", FaultyRanks::parameters()};
const RegisterMutant<TopsLeftOut<2>> of_near{
    "tops-of-a-border-left-out", "a loop over tops that ends after the first", FaultyRanks::parameters()};

class AroundTooSmall final : public FaultyRanks {
  void spoil_gathered(Phase phase, unsigned time, Bytes& bytes) const override {
    if (phase != Phase::across || time != 1 || bytes.empty()) return;
    Box box = ByteReader(bytes).get<Box>();
    for (int axis = 0; axis < 3; ++axis) box.high[axis] = box.low[axis] / 2 + box.high[axis] / 2;
    std::memcpy(bytes.data(), &box, sizeof box);
  }
};
const RegisterMutant<AroundTooSmall> around{
    "box-around-a-rank-too-small", "a box around some of what a rank holds", FaultyRanks::parameters()};

class BlockNotAsked final : public FaultyRanks {
  void spoil_question(std::vector<std::uint32_t>& wanted) const override { wanted.pop_back(); }
};
const RegisterMutant<BlockNotAsked> not_asked{
    "block-of-a-rank-not-asked-for", "a question that is one block short", FaultyRanks::parameters()};

class BlockAskedTwice final : public FaultyRanks {
  void spoil_question(std::vector<std::uint32_t>& wanted) const override { wanted.push_back(wanted.front()); }
};
const RegisterMutant<BlockAskedTwice> twice{"block-of-a-rank-asked-for-twice",
                                            "rounds of questions that overlap by a block",
                                            FaultyRanks::parameters()};

/// Spheres, and arcs, that go to another rank.
class MovedAskew final : public FaultyRanks {
  void spoil_arrived(Phase phase, std::span<std::byte> bytes) const override {
    if (phase == Phase::repartition && bytes.size() > sizeof(Sphere))
      std::rotate(bytes.begin(), bytes.begin() + sizeof(Sphere), bytes.end());
  }
};
const RegisterMutant<MovedAskew> askew{"moved-spheres-one-place-off",
                                       "a share that is copied from a sphere too late",
                                       FaultyRanks::parameters()};

class LastOneLost final : public FaultyRanks {
  void spoil_arrived(Phase phase, std::span<std::byte> bytes) const override {
    if (phase != Phase::repartition || bytes.size() < 2 * sizeof(Sphere)) return;
    const auto last = bytes.last(sizeof(Sphere));
    std::ranges::copy(bytes.first(sizeof(Sphere)), last.begin());
  }
};
const RegisterMutant<LastOneLost> lost{"moved-sphere-lost", "a round that ends a sphere too soon",
                                       FaultyRanks::parameters()};

}  // namespace
}  // namespace catena::properties
