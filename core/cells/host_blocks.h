#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/first_look.h"
#include "catena/core/cells/host_buckets.h"
#include "catena/core/cells/host_warp.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/core/executor/host_group.h"

namespace catena {

/// A CapsuleBlocks on the host, its steps run one after the other, warps emulated: the device's twin. Keeps
/// its memory.
class HostBlocks {
 public:
  /// Lays blocks out and encloses their spheres in capsules, unless all are crowded.
  const CapsuleBlocks& enclose(const ChainView& chain, const CapsuleBlocks& laid_out) {
    blocks_ = laid_out;
    if (blocks_.all_crowded) return blocks_;
    reserve();
    const BlockMeeting meeting(blocks_);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b)
      meeting.enclose(
          HostQuad(), [&](std::uint32_t k) { return scaled(chain, b, k); }, b);
    look(chain);
    return blocks_;
  }

  /// Where there are tangled ones for the cells: puts them there and finds whom they meet.
  void meet_in_cells() {
    if (!blocks_.any_in_cells()) return;
    const BlockMeeting meeting(blocks_);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) meeting.enter(b);
    buckets_.allocate();
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) meeting.place(b);
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b)
      if (blocks_.looks(b)) meet(meeting, b);
  }

  const CapsuleBlocks& blocks() const { return blocks_; }

 private:
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

  void look(const ChainView& chain) {
    FirstLook::Memory memory;
    for (std::uint32_t k = 0; k < FirstLook::groups(blocks_); ++k)
      FirstLook(chain, blocks_, memory).look(HostGroup(32), k);
    FirstLook::tell(blocks_);
  }

  void reserve() {
    const std::size_t n = blocks_.blocks;
    capsule_.resize(n), shape_.resize(n), ball_.resize(n), id_.resize(n);
    partners_.resize(n), met_.resize(n), partner_.resize(CapsuleBlocks::most_partners * n);
    state_ = {}, look_ = {};
    blocks_.capsule = capsule_.data(), blocks_.shape = shape_.data();
    blocks_.ball = ball_.data(), blocks_.id = id_.data();
    blocks_.partners = partners_.data(), blocks_.met = met_.data(), blocks_.partner = partner_.data();
    blocks_.state = &state_;
    blocks_.look = FirstLook::pays(blocks_) ? &look_ : nullptr;
    blocks_.buckets = buckets_.reserve(blocks_.table, n);
  }
  /// Sphere k of block b and those after it, in the blocks' units.
  Sphere scaled(const ChainView& chain, std::uint32_t b, std::uint32_t k) const {
    return blocks_.scaled(chain.spheres[std::min(b * CapsuleBlocks::block + k, chain.size - 1)]);
  }

  CapsuleBlocks blocks_{};
  CapsuleBlocks::State state_{};
  CapsuleBlocks::Look look_{};
  std::vector<BlockCapsule> capsule_;
  std::vector<CapsuleBall> ball_;
  std::vector<std::uint8_t> shape_;
  std::vector<std::uint32_t> id_, partners_, partner_, met_;
  HostBuckets buckets_;
};

}  // namespace catena
