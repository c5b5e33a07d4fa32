#pragma once
#include <cstdint>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/capsule_blocks.h"

namespace catena {

/// Steps of a CapsuleBlocks, each for one block by one warp; who runs them lets each step end before the next
/// begins.
template <class Warp>
class BlockMeeting {
 public:
  template <class T>
  using Lanes = typename Warp::template Lanes<T>;

  /// What there is to compare a block with: those below `within` are its partners.
  enum class Work : std::uint8_t {
    within = CapsuleBlocks::most_partners,
    adjacent,  ///< spheres next to one another, in a block in which no others can collide
    coarser,   ///< blocks of coarser levels, for a crowded block
    kinds
  };

  CATENA_HD BlockMeeting(const Warp& warp, const ChainView& chain, const CapsuleBlocks& blocks)
      : warp_(warp), chain_(chain), blocks_(blocks) {}

  /// Step 1: the capsule of block b, into its bucket.
  CATENA_HD void enclose(std::uint32_t b) const {
    constexpr std::uint32_t size = CapsuleBlocks::block;
    const auto own = warp_.each([&](std::uint32_t lane) { return scaled(b * size + lane); });
    const auto next = warp_.each([&](std::uint32_t lane) { return scaled((b + 1) * size + lane); });
    const auto at = [&](std::uint32_t k) { return scaled(b * size + k); };
    const BlockPair<Warp> pair{warp_, own, next, at(0), at(15), at(16), at(31), at(63)};
    const BlockCapsule capsule = pair.capsule();
    // Never where two or more stand in for spheres behind the last one.
    const bool ordered = pair.ordered(capsule);
    const std::uint32_t level = CapsuleBlocks::level_of(capsule.reach),
                        bucket = blocks_.bucket_of(capsule, level);
    warp_.once([&] {
      blocks_.capsule[b] = capsule;
      blocks_.shape[b] = static_cast<std::uint8_t>(level | (ordered ? CapsuleBlocks::is_ordered : 0));
      set_bits(&blocks_.state->levels, 1u << level);
      const std::uint32_t slot = fetch_add(blocks_.in_bucket + bucket, 1);
      if (slot < CapsuleBlocks::slots) blocks_.bucket[bucket * CapsuleBlocks::slots + slot] = b << 5 | level;
    });
  }

  /// Step 2: whom block b meets, of its level and of coarser ones.
  CATENA_HD void meet(std::uint32_t b) const {
    const BlockCapsule own = blocks_.capsule[b];
    const std::uint32_t level = blocks_.level(b), levels = blocks_.state->levels;
    std::uint32_t found = 0;
    bool room = true;
    for (std::uint32_t other = level; room && levels >> other != 0; ++other) {
      if ((levels >> other & 1) == 0) continue;
      room = around(own, other, [&](const Lanes<std::uint32_t>& entry) {
        const std::uint32_t near = warp_.ballot(
            [&](std::uint32_t lane) { return entry[lane] != none && meets(b, own, other, entry[lane]); });
        note_partners(b, entry, near, found, other != level);
        found += count_bits(near);
      });
      room = room && found <= blocks_.crowd;
    }
    warp_.once([&] {
      blocks_.partners[b] = room ? static_cast<std::uint8_t>(found) : CapsuleBlocks::is_crowded;
      if (room) return;
      set_bits(&blocks_.state->any, 1);
      if (b % blocks_.sample == 0) fetch_add(&blocks_.state->crowded, 1);
    });
  }

  /// Step 3: what block b is to be compared with, as far as it is this block's to do: add(item) for each item
  /// of work. By one thread.
  template <class Add>
  CATENA_HD void plan(std::uint32_t b, const Add& add) const {
    const bool ordered = blocks_.ordered(b);
    if (blocks_.crowded(b)) {
      if (blocks_.state->levels >> blocks_.level(b) >> 1 != 0) add(Work::coarser);
    } else {
      if (!ordered) add(Work::within);
      for (std::uint32_t k = 0; k < blocks_.partners[b]; ++k) {
        const std::uint32_t id = blocks_.partner[b * CapsuleBlocks::most_partners + k];
        // Of one level both met the other.
        if (id > b || blocks_.crowded(id) || blocks_.level(id) != blocks_.level(b)) add(static_cast<Work>(k));
      }
    }
    const bool neighbours =
        chain_.strand_count == 1 && chain_.exclusion.rule == Exclusion::Rule::index_window;
    if (ordered && !neighbours) add(Work::adjacent);
  }

  /// Step 4, for each item of block b; tells what collides to sink.pair(i, j), i < j.
  template <class Tests, class Sink>
  CATENA_HD void compare(std::uint32_t b, Work work, Sink& sink) const {
    if (work == Work::within) return compare_within<Tests>(b, sink);
    if (work == Work::adjacent) return compare_adjacent<Tests>(b, sink);
    if (work == Work::coarser) return compare_with_coarser<Tests>(b, sink);
    const std::uint32_t k = static_cast<std::uint32_t>(work),
                        id = blocks_.partner[b * CapsuleBlocks::most_partners + k];
    compare_two<Tests>(b < id ? b : id, b < id ? id : b, sink);
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  /// Sphere i, or the last one, in the blocks' units.
  CATENA_HD Sphere scaled(std::uint32_t i) const {
    const Sphere s = chain_.spheres[i < chain_.size ? i : chain_.size - 1];
    return {s.x * blocks_.scale, s.y * blocks_.scale, s.z * blocks_.scale, s.radius * blocks_.scale};
  }

  /// Calls visit(entry) with what is in the buckets of level `of` around a capsule, an entry or `none` a
  /// lane. False, and not all were visited, where a bucket had more than it holds.
  template <class Visit>
  CATENA_HD bool around(const BlockCapsule& capsule, std::uint32_t of, const Visit& visit,
                        bool pass_over_full = false) const {
    constexpr std::uint32_t slots = CapsuleBlocks::slots, cells = 27;
    const std::uint32_t centre = blocks_.bucket_of(capsule, of);
    const auto bucket =
        warp_.each([&](std::uint32_t lane) { return lane < cells ? blocks_.around(centre, lane) : 0; });
    const auto size =
        warp_.each([&](std::uint32_t lane) { return lane < cells ? blocks_.in_bucket[bucket[lane]] : 0; });
    if (!pass_over_full && warp_.ballot([&](std::uint32_t lane) { return size[lane] > slots; }) != 0)
      return false;
    for (std::uint32_t k = 0; k < slots; ++k) {
      const auto entry = warp_.each([&](std::uint32_t lane) {
        return k < size[lane] && size[lane] <= slots ? blocks_.bucket[bucket[lane] * slots + k] : none;
      });
      if (warp_.ballot([&](std::uint32_t lane) { return entry[lane] != none; }) == 0) break;
      visit(entry);
    }
    return true;
  }

  /// Of these entries those of the lanes `near` are partners of block b, which has `found` already.
  CATENA_HD void note_partners(std::uint32_t b, const Lanes<std::uint32_t>& entry, std::uint32_t near,
                               std::uint32_t found, bool coarser) const {
    warp_.run([&](std::uint32_t lane) {
      if ((near >> lane & 1) == 0) return;
      const std::uint32_t place = found + count_bits(near & ((1u << lane) - 1)), id = entry[lane] >> 5;
      if (place < blocks_.crowd) blocks_.partner[b * CapsuleBlocks::most_partners + place] = id;
      if (coarser && fetch_add(blocks_.met + id, 1) == CapsuleBlocks::most_met)
        set_bits(&blocks_.state->any, 1);
    });
  }

  /// Block b, of this capsule, and the block of an entry may collide, and that one is of level `of`.
  CATENA_HD bool meets(std::uint32_t b, const BlockCapsule& own, std::uint32_t of,
                       std::uint32_t entry) const {
    const std::uint32_t id = entry >> 5;
    if ((entry & 31) != of || id == b || far_apart(own, blocks_.capsule[id])) return false;
    if ((id == b + 1 && blocks_.ordered(b)) || (b == id + 1 && blocks_.ordered(id))) return false;
    return !separate(own, blocks_.capsule[id]);
  }

  /// A crowded block found no partners, and blocks of its own level find it; but those of coarser levels do
  /// not.
  template <class Tests, class Sink>
  CATENA_HD void compare_with_coarser(std::uint32_t b, Sink& sink) const {
    const std::uint32_t level = blocks_.level(b), levels = blocks_.state->levels;
    const BlockCapsule own = blocks_.capsule[b];
    for (std::uint32_t other = level + 1; levels >> other != 0; ++other) {
      if ((levels >> other & 1) == 0) continue;
      around(
          own, other,
          [&](const Lanes<std::uint32_t>& entry) {
            std::uint32_t near = warp_.ballot([&](std::uint32_t lane) {
              return entry[lane] != none && !blocks_.crowded(entry[lane] >> 5) &&
                     meets(b, own, other, entry[lane]);
            });
            for (; near != 0; near &= near - 1) {
              const std::uint32_t id = warp_.from(entry, lowest_bit(near)) >> 5;
              compare_two<Tests>(b < id ? b : id, b < id ? id : b, sink);
            }
          },
          true);
    }
  }

  /// Blocks a < b.
  template <class Tests, class Sink>
  CATENA_HD void compare_two(std::uint32_t a, std::uint32_t b, Sink& sink) const {
    const std::uint32_t near_a = near(a, blocks_.capsule[b]);
    if (near_a == 0) return;
    compare_spheres<Tests>(a, near_a, b, near(b, blocks_.capsule[a]), sink);
  }
  template <class Tests, class Sink>
  CATENA_HD void compare_within(std::uint32_t b, Sink& sink) const {
    const std::uint32_t all = warp_.ballot([&](std::uint32_t lane) { return in_chain(b, lane); });
    compare_spheres<Tests>(b, all, b, all, sink);
  }

  CATENA_HD bool in_chain(std::uint32_t b, std::uint32_t k) const {
    return b * CapsuleBlocks::block + k < chain_.size;
  }

  /// Which spheres of block b a capsule may collide with.
  CATENA_HD std::uint32_t near(std::uint32_t b, const BlockCapsule& capsule) const {
    return warp_.ballot([&](std::uint32_t lane) {
      return in_chain(b, lane) &&
             !separate(BlockCapsule::around(scaled(b * CapsuleBlocks::block + lane)), capsule);
    });
  }

  template <class Tests, class Sink>
  CATENA_HD void compare_spheres(std::uint32_t a, std::uint32_t of_a, std::uint32_t b, std::uint32_t of_b,
                                 Sink& sink) const {
    const auto first = spheres(a), second = spheres(b);
    for (; of_b != 0; of_b &= of_b - 1) {
      const std::uint32_t k = lowest_bit(of_b), j = b * CapsuleBlocks::block + k;
      const Sphere other = warp_.from(second, k);
      warp_.run([&](std::uint32_t lane) {
        const std::uint32_t i = a * CapsuleBlocks::block + lane;
        if ((of_a >> lane & 1) != 0 && i < j && Tests::overlap(first[lane], other) &&
            !chain_.neighbours(i, j))
          sink.pair(i, j);
      });
    }
  }
  CATENA_HD Lanes<Sphere> spheres(std::uint32_t b) const {
    return warp_.each([&](std::uint32_t lane) {
      const std::uint32_t i = b * CapsuleBlocks::block + lane;
      return chain_.spheres[i < chain_.size ? i : chain_.size - 1];
    });
  }

  /// Spheres next to one another, of an ordered block and the first of the next.
  template <class Tests, class Sink>
  CATENA_HD void compare_adjacent(std::uint32_t b, Sink& sink) const {
    const bool left_out = blocks_.crowded(b), last_too = !left_out || !blocks_.crowded(b + 1);
    warp_.run([&](std::uint32_t lane) {
      if (lane == CapsuleBlocks::block - 1 ? !last_too : left_out) return;
      const std::uint32_t i = b * CapsuleBlocks::block + lane;
      if (Tests::overlap(chain_.spheres[i], chain_.spheres[i + 1]) && !chain_.neighbours(i, i + 1))
        sink.pair(i, i + 1);
    });
  }

  const Warp& warp_;
  const ChainView& chain_;
  const CapsuleBlocks& blocks_;
};

}  // namespace catena
