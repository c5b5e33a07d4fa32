#include <fmt/format.h>

#include <vector>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/host_sphere_cells.h"
#include "catena/core/cells/host_warp.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// DeviceHybrid with its steps run on the host, one after the other, warps emulated.
template <class Arithmetic>
class DeviceHybridOnHost final : public HostSearch {
 public:
  explicit DeviceHybridOnHost(const Parameters& parameters)
      : crowd_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("crowd", 0, CapsuleBlocks::most_partners))) {}

  Plan plan() const override {
    Plan plan = range_checks_plan<Arithmetic>(in_range_);
    std::uint32_t crowded = 0;
    for (std::uint32_t b = 0; built() && b < blocks_.blocks; ++b) crowded += blocks_.crowded(b);
    plan.push_back({"grid of spheres", crowded == 0,
                    fmt::format("{} of {} blocks of 32 spheres are crowded", crowded, blocks_.blocks)});
    return plan;
  }

 private:
  void construct(const ChainView& chain) override {
    lay_out(chain);
    const BlockMeeting<HostWarp> meeting(warp_, chain, blocks_);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) meeting.enclose(b);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) meeting.meet(b);
    cells_.build(chain, blocks_.crowded_spheres(),
                 [&](std::uint32_t i) { return blocks_.crowded(i / CapsuleBlocks::block); });
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      const BlockMeeting<HostWarp> meeting(warp_, chain, blocks_);
      for (std::uint32_t b = 0; b < blocks_.blocks && !sink.satisfied(); ++b)
        meeting.plan(b, [&](auto work) { meeting.template compare<decltype(tests)>(b, work, sink); });
      cells_.search<decltype(tests)>(chain, sink);
    });
    in_range_ = in_range<Arithmetic>(chain);
  }
  void lay_out(const ChainView& chain) {
    blocks_ = CapsuleBlocks::of(chain, crowd_, block_scale(chain.extent));
    capsule_.resize(blocks_.blocks);
    shape_.resize(blocks_.blocks);
    partners_.resize(blocks_.blocks);
    partner_.resize(std::size_t{CapsuleBlocks::most_partners} * blocks_.blocks);
    met_.assign(blocks_.blocks, 0);
    in_bucket_.assign(blocks_.table.buckets, 0);
    bucket_.resize(std::size_t{CapsuleBlocks::slots} * blocks_.table.buckets);
    state_ = {};
    blocks_.capsule = capsule_.data(), blocks_.shape = shape_.data(), blocks_.partners = partners_.data();
    blocks_.partner = partner_.data(), blocks_.met = met_.data(), blocks_.in_bucket = in_bucket_.data();
    blocks_.bucket = bucket_.data(), blocks_.state = &state_;
  }

  const std::uint32_t crowd_;
  HostWarp warp_;
  CapsuleBlocks blocks_{};
  CapsuleBlocks::State state_{};
  std::vector<BlockCapsule> capsule_;
  std::vector<std::uint8_t> shape_, partners_;
  std::vector<std::uint32_t> in_bucket_, bucket_, partner_, met_;
  HostSphereCells cells_;
  bool in_range_ = false;
};

const RegisterVariant<DeviceHybridOnHost, Robust> registered{
    {.name = "DeviceHybrid@host",
     .summary = "capsules of 32 spheres in hashed cells, and DeviceGrid where they are crowded",
     .parameters = {{"crowd", "8", "a block that meets more others is left to the grid"}}}};

}  // namespace
}  // namespace catena
