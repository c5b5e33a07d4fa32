#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/compare_blocks.h"
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
    const BlockMeeting meeting(blocks_);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b)
      meeting.enclose(
          HostQuad(), [&](std::uint32_t k) { return scaled(chain, b, k); }, b);
    buckets_.allocate();
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) meeting.place(b);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) meet(meeting, b);
    cells_.build(chain, blocks_.crowded_spheres(),
                 [&](std::uint32_t i) { return blocks_.crowded(i / CapsuleBlocks::block); });
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      const BlockComparison<HostWarp> comparison(warp_, chain, blocks_);
      for (std::uint32_t b = 0; b < blocks_.blocks && !sink.satisfied(); ++b)
        comparison.plan(b, [&](auto work) { comparison.template compare<decltype(tests)>(b, work, sink); });
      cells_.search<decltype(tests)>(chain, sink);
    });
    in_range_ = in_range<Arithmetic>(chain);
  }
  void meet(const BlockMeeting& meeting, std::uint32_t b) const {
    for (std::uint32_t levels = state_.levels >> blocks_.level(b) << blocks_.level(b); levels != 0;
         levels &= levels - 1)
      for (std::uint32_t row = 0; row < BlockMeeting::rows; ++row) {
        CapsuleBlocks::Row rest;
        Buckets::Run run = meeting.look(b, lowest_bit(levels), row, rest);
        for (;; run = meeting.look_on(rest)) {
          if (BlockMeeting::too_many(run)) return meeting.crowd(b);
          for (std::uint32_t at = run.first; at < run.end; ++at)
            if (meeting.may_meet(b, ball_of(blocks_.capsule[b]), lowest_bit(levels), at))
              meeting.note(b, meeting.block_at(at));
          if (rest.cells == 0) break;
        }
      }
  }

  void lay_out(const ChainView& chain) {
    blocks_ = CapsuleBlocks::of(chain, crowd_, block_scale(chain.extent));
    const std::size_t n = blocks_.blocks;
    capsule_.resize(n), shape_.resize(n), ball_.resize(n), id_.resize(n);
    partners_.resize(n), met_.resize(n), partner_.resize(CapsuleBlocks::most_partners * n);
    state_ = {};
    blocks_.capsule = capsule_.data(), blocks_.shape = shape_.data();
    blocks_.ball = ball_.data(), blocks_.id = id_.data();
    blocks_.partners = partners_.data(), blocks_.met = met_.data(), blocks_.partner = partner_.data();
    blocks_.state = &state_;
    blocks_.buckets = buckets_.reserve(blocks_.table, n);
  }
  /// Sphere k of block b and those after it, in the blocks' units.
  Sphere scaled(const ChainView& chain, std::uint32_t b, std::uint32_t k) const {
    return blocks_.scaled(chain.spheres[std::min(b * CapsuleBlocks::block + k, chain.size - 1)]);
  }

  const std::uint32_t crowd_;
  HostWarp warp_;
  CapsuleBlocks blocks_{};
  CapsuleBlocks::State state_{};
  std::vector<BlockCapsule> capsule_;
  std::vector<CapsuleBall> ball_;
  std::vector<std::uint8_t> shape_;
  std::vector<std::uint32_t> id_, partners_, partner_, met_;
  HostBuckets buckets_;
  HostSphereCells cells_;
  bool in_range_ = false;
};

const RegisterVariant<DeviceHybridOnHost, Robust> registered{
    {.name = "DeviceHybrid@host",
     .summary = "capsules of 32 spheres in hashed cells, and DeviceGrid where they are crowded",
     .parameters = {{"crowd", "8", "a block that meets more others is left to the grid"}}}};

}  // namespace
}  // namespace catena
