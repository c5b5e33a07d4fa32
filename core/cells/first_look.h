#pragma once
#include <cmath>
#include <cstdint>

#include "catena/core/cells/block_capsule.h"
#include "catena/core/cells/capsule_blocks.h"

namespace catena {

/// Guesses from some spheres of some blocks, while capsules are made of all, that blocks meet so many others
/// that all had better be left to the other search (CapsuleBlocks::all_left): the survey (BlockSurvey) is not
/// needed then. Blocks of all parts of the chain are asked whether they meet any of every fourth block, or
/// so, and whoever encloses them says whether they go on in order. Only who finds a pair depends on this, and
/// not whether it is found. O(64 blocks / looked).
class FirstLook {
 public:
  static constexpr std::uint32_t asked = CapsuleBlocks::Look::asked, words = CapsuleBlocks::Look::words,
                                 together = 64;
  struct Memory {  ///< of a group
    BlockCapsule capsule[asked + together];
    CapsuleBall ball[asked];
    std::uint32_t met[words];
  };

  /// Fewer blocks take no longer to be asked in full.
  CATENA_HD static bool pays(const CapsuleBlocks& blocks) {
    return blocks.surveyed > 0 && blocks.alike && !blocks.own_units && blocks.blocks >= 4 * asked;
  }
  CATENA_HD static std::uint32_t groups(const CapsuleBlocks& blocks) {
    return blocks.look == nullptr ? 0 : (blocks.blocks / blocks.looked + together - 1) / together;
  }

  CATENA_HD FirstLook(const ChainView& chain, const CapsuleBlocks& blocks, Memory& memory)
      : chain_(chain), blocks_(blocks), memory_(memory) {}

  /// By one of those groups of threads, which ends in step: whom of its share of the chain's blocks those
  /// asked meet.
  template <class Group>
  CATENA_HD void look(Group&& group, std::uint32_t share) const {
    group.parallel(asked + together, [this, share](std::uint32_t k) {
      if (k < words) memory_.met[k] = 0;
      const std::uint32_t b = k < asked ? blocks_.block_asked(k) : other(share * together + k - asked);
      if (b >= blocks_.blocks) return;
      const BlockCapsule capsule = thin_capsule(b);
      memory_.capsule[k] = capsule;
      if (k < asked) memory_.ball[k] = ball_of(capsule);
    });
    group.barrier();
    group.parallel(together * words, [this, share](std::uint32_t k) {
      const std::uint32_t word = k / together, b = other(share * together + k % together);
      if (b < blocks_.blocks) meet(b, memory_.capsule[asked + k % together], word, k % 32);
    });
    group.barrier();
    group.parallel(words, [this](std::uint32_t word) {
      if (memory_.met[word] != 0) set_bits(blocks_.look->met + word, memory_.met[word]);
    });
    group.barrier();
  }

  /// Once all have looked: in place of what the survey would say, by one thread.
  CATENA_HD static void tell(const CapsuleBlocks& blocks) {
    if (blocks.left_at_first_look())
      blocks.state->survey = CapsuleBlocks::Survey{blocks.surveyed, blocks.surveyed, 0, 0}.number();
  }
  /// When nobody asks any more, by one thread: the next build begins with nothing.
  CATENA_HD static void forget(const CapsuleBlocks& blocks) {
    if (blocks.look != nullptr) *blocks.look = {};
  }

 private:
  /// The k-th of those that they may meet, anywhere in its part of the chain.
  CATENA_HD std::uint32_t other(std::uint32_t k) const {
    return k * blocks_.looked + scattered(k, blocks_.looked);
  }

  /// Of a word's blocks those that block b meets, among the first few that are near. Threads of a group begin
  /// with others of them, so that it is known by and by of most where many meet, and not asked again.
  CATENA_HD void meet(std::uint32_t b, const BlockCapsule& capsule, std::uint32_t word,
                      std::uint32_t from) const {
    constexpr std::uint32_t few = 6;
    const CapsuleBall own = ball_of(capsule);
    std::uint32_t* const met = memory_.met + word;
    std::uint32_t near = 0;
    for (std::uint32_t k = 0; k < 32; ++k)
      near |= (far_apart(own, memory_.ball[word * 32 + k], false) ? 0u : 1u) << k;
    for (std::uint32_t k = 0; k < few && (near &= ~seen(met)) != 0; ++k) {
      const std::uint32_t ahead = near >> from << from, bit = lowest_bit(ahead != 0 ? ahead : near);
      const std::uint32_t apart =
          blocks_.block_asked(word * 32 + bit) - b + 1;  // up to 2: the same, or next to it
      if (apart > 2 && !separate(capsule, memory_.capsule[word * 32 + bit], false)) set_bits(met, 1u << bit);
      near &= ~(1u << bit);
    }
  }

  /// About the chord and half of the arc, as BlockFit has it, and as thick as four spheres between ask for.
  CATENA_HD BlockCapsule thin_capsule(std::uint32_t b) const {
    constexpr std::uint32_t all = 6, step = 6;
    static_assert(all * step > CapsuleBlocks::block && (all - 1) * step < CapsuleBlocks::block);
    Sphere s[all];
    for (std::uint32_t k = 0; k < all; ++k) s[k] = sphere(b, k * step);
    const Vector32 origin = centre_of(s[0]), chord = centre_of(s[all - 1]) - origin,
                   arc = (centre_of(s[2]) - origin) + (centre_of(s[3]) - origin);
    BlockCapsule result{};
    result.half = 0.5f * chord;
    result.centre = plus(plus(origin, 0.5f, result.half), 0.25f, arc);
    const float square = dot(result.half, result.half), over = BlockCapsule::inverse_square(square);
    float farthest = 0, thickest = 0;
    for (const Sphere& of : s) {
      const Vector32 p = centre_of(of) - result.centre,
                     rest = plus(p, -clamped(dot(p, result.half) * over), result.half);
      farthest = std::fmax(farthest, dot(rest, rest)), thickest = std::fmax(thickest, of.radius);
    }
    result.radius = std::sqrt(farthest) + thickest;
    result.reach = std::sqrt(square) + result.radius;
    return result;
  }
  /// Of a block; behind the chain's end its last sphere again.
  CATENA_HD Sphere sphere(std::uint32_t b, std::uint32_t k) const {
    const std::uint32_t at = b * CapsuleBlocks::block + k;
    return blocks_.scaled(chain_.spheres[at < chain_.size ? at : chain_.size - 1]);
  }

  const ChainView& chain_;
  const CapsuleBlocks& blocks_;
  Memory& memory_;
};

}  // namespace catena
