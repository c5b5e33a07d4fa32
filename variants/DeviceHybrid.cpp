#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/find_partners.h"
#include "catena/core/cells/host_block_nodes.h"
#include "catena/core/cells/host_comparison.h"
#include "catena/core/cells/host_sphere_cells.h"
#include "catena/core/cells/host_warp.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/core/cells/survey_blocks.h"
#include "catena/core/cells/told_search.h"
#include "catena/core/executor/host_group.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// DeviceHybrid with its steps run on the host, one after the other, warps emulated.
template <class Arithmetic>
class DeviceHybridOnHost final : public HostSearch, public EvidenceNodes {
 public:
  explicit DeviceHybridOnHost(const Parameters& parameters)
      : crowd_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("crowd", 0, CapsuleBlocks::most_partners))),
        least_(parameters.unsigned_integer("least", 0, 0xFFFFFFFFu)),
        least_in_cells_(parameters.unsigned_integer("cells", 0, 0xFFFFFFFFu)),
        surveyed_(static_cast<std::uint32_t>(
            parameters.unsigned_integer("survey", 0, CapsuleBlocks::most_surveyed))) {}

  Plan plan() const override {
    Plan plan = range_checks_plan<Arithmetic>(in_range_);
    std::uint32_t crowded = blocks_.all_crowded ? blocks_.blocks : 0, tangled = 0;
    for (std::uint32_t b = 0; built() && !blocks_.all_crowded && b < blocks_.blocks; ++b)
      crowded += blocks_.crowded(b), tangled += blocks_.tangled(b);
    plan.push_back({"capsules in cells", tangled == 0,
                    fmt::format("{} of {} blocks of 32 spheres are tangled", tangled, blocks_.blocks)});
    plan.push_back({"grid of spheres", crowded == 0,
                    fmt::format("{} of {} blocks of 32 spheres are crowded", crowded, blocks_.blocks)});
    return plan;
  }

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) ToldSearch(chain.view(), &blocks_, cells_.placed()).show(visitor);
  }

 private:
  void construct(const ChainView& chain) override {
    lay_out(chain);
    if (blocks_.all_crowded) return cells_.build(chain, chain.size, [](std::uint32_t) { return true; });
    const BlockMeeting meeting(blocks_);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b)
      meeting.enclose(
          HostQuad(), [&](std::uint32_t k) { return scaled(chain, b, k); }, b);
    if (blocks_.blocks > 0) meet_in_tree();
    if (blocks_.any_in_cells()) meet_in_cells(meeting);
    cells_.build(chain, blocks_.crowded_spheres(),
                 [&](std::uint32_t i) { return blocks_.crowded(i / CapsuleBlocks::block); });
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    LaneSink sink{collector.lane(0)};
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      compare_blocks<decltype(tests)>(chain, blocks_, sink);
      cells_.placed().search<decltype(tests)>(chain, sink);
    });
    in_range_ = in_range<Arithmetic>(chain);
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    ToldSearch(chain, &blocks_, cells_.placed()).search(lane, sink);
  }
  void meet_in_tree() {
    const BlockNodes& nodes = nodes_.fit(blocks_);
    HostGroup group(32);
    for (std::uint32_t k = 0; k < blocks_.surveyed; ++k)
      BlockSurvey(nodes, blocks_, of_survey_).ask(group, k);
    for (std::uint32_t k = 0; k < nodes.count[2]; ++k)
      PartnerSearch(nodes, blocks_, of_search_).find(group, k);
  }

  void meet_in_cells(const BlockMeeting& meeting) {
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) meeting.enter(b);
    buckets_.allocate();
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) meeting.place(b);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b)
      if (blocks_.looks(b)) meet(meeting, b);
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
    blocks_ = CapsuleBlocks::of(chain, crowd_, block_scale(chain.extent), least_, least_in_cells_, surveyed_);
    if (blocks_.all_crowded) return;
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
  const std::uint64_t least_, least_in_cells_;
  const std::uint32_t surveyed_;
  CapsuleBlocks blocks_{};
  CapsuleBlocks::State state_{};
  HostBlockNodes nodes_;
  BlockSurvey::Memory of_survey_{};
  PartnerSearch::Memory of_search_{};
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
     .summary = "capsules of 32 spheres in a tree along the chain, in hashed cells where it is tangled, "
                "DeviceGrid where crowded",
     .parameters = {{"crowd", "8", "a block that meets more others is left to the grid"},
                    {"least", "0", "chains of fewer spheres are left to the grid; DeviceHybrid: 300000"},
                    {"cells", "0",
                     "tangled blocks of chains of fewer spheres are left to the grid; DeviceHybrid: 4194304"},
                    {"survey", "64",
                     "blocks asked first whom they meet: the grid gets all where it takes less; 0: none"}}}};

}  // namespace
}  // namespace catena
