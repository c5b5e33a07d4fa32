#pragma once
#include <cstdint>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/pair.h"

namespace catena {

/// Compares the spheres of blocks that met, once all have: what there is to do for a block, and the doing, by
/// a warp. `own_units` as the blocks have it, so that who has none pays nothing for it.
template <class Warp, bool own_units>
class BlockComparison {
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

  CATENA_HD BlockComparison(const Warp& warp, const ChainView& chain, const CapsuleBlocks& blocks)
      : warp_(warp), chain_(chain), blocks_(blocks) {}

  /// What block b is to be compared with, as far as it is this block's to do: add(item) for each item of
  /// work. By one thread.
  template <class Add>
  CATENA_HD void plan(std::uint32_t b, const Add& add) const {
    const bool ordered = blocks_.ordered(b);
    if (blocks_.crowded(b)) {
      if (blocks_.tangled(b) && blocks_.state->levels >> blocks_.level(b) >> 1 != 0) add(Work::coarser);
    } else {
      if (!ordered) add(Work::within);
      for (std::uint32_t k = 0; k < blocks_.partners[b]; ++k) {
        const std::uint32_t other = blocks_.partner[b * CapsuleBlocks::most_partners + k];
        // In the tree those that are not tangled met one another, in cells those of one level.
        const bool both =
            blocks_.tangled(b) ? blocks_.level(other) == blocks_.level(b) : !blocks_.tangled(other);
        if (other > b || blocks_.crowded(other) || !both) add(static_cast<Work>(k));
      }
    }
    const bool neighbours =
        chain_.strand_count == 1 && chain_.exclusion.rule == Exclusion::Rule::index_window;
    if (ordered && !neighbours) add(Work::adjacent);
  }

  /// For each item of block b; tells what collides to sink.collide(lanes, pair), by all lanes together: of
  /// each lane whose bit is set pair(lane), i < j. How often a sphere was in these is told by sink.count(i,
  /// times), by each lane of its own ones. A sink on the host that listens is also told which blocks it
  /// compared, sink.met(a, near_a, b, near_b), and which spheres, sink.compared(i, j): see CapsuleEvidence.
  template <class Tests, class Sink>
  CATENA_HD void compare(std::uint32_t b, Work work, Sink& sink) const {
    if (work == Work::within) return compare_within<Tests>(b, sink);
    if (work == Work::adjacent) return compare_adjacent<Tests>(b, sink);
    if (work == Work::coarser) return compare_with_coarser<Tests>(b, sink);
    const std::uint32_t k = static_cast<std::uint32_t>(work),
                        other = blocks_.partner[b * CapsuleBlocks::most_partners + k];
    compare_two<Tests>(b < other ? b : other, b < other ? other : b, sink);
  }

  /// Two blocks that may meet, a < b; tells as compare() does.
  template <class Tests, class Sink>
  CATENA_HD void compare_two(std::uint32_t a, std::uint32_t b, Sink& sink) const {
    const auto first = spheres(a), second = spheres(b);
    const std::uint32_t near_a = near(a, first, blocks_.capsule[b]);
    if constexpr (listens<Sink>) sink.met(a, near_a, b, near(b, second, blocks_.capsule[a]));
    if (near_a == 0) return;
    compare_spheres<Tests>(a, first, near_a, b, second, near(b, second, blocks_.capsule[a]), sink);
  }

 private:
  template <class Sink>
  static constexpr bool listens = requires(Sink sink) {
    sink.met(0u, 0u, 0u, 0u);
  };

  /// A crowded block found no partners, and blocks of its own level find it; but those of coarser levels do
  /// not. They are in no bucket that holds too many.
  template <class Tests, class Sink>
  CATENA_HD void compare_with_coarser(std::uint32_t b, Sink& sink) const {
    const std::uint32_t level = blocks_.level(b), levels = blocks_.state->levels;
    const BlockCapsule own = blocks_.capsule[b];
    for (std::uint32_t other = level + 1; levels >> other != 0; ++other)
      if ((levels >> other & 1) != 0) compare_around<Tests>(b, own, other, sink);
  }

  template <class Tests, class Sink>
  CATENA_HD void compare_around(std::uint32_t b, const BlockCapsule& own, std::uint32_t level,
                                Sink& sink) const {
    constexpr std::uint32_t cells = 27;
    const std::uint32_t centre = blocks_.bucket_of(own, level);
    const auto run = warp_.each([&](std::uint32_t lane) {
      const Buckets::Run all = blocks_.buckets.in(blocks_.around(centre, lane < cells ? lane : 0));
      return lane < cells && all.end - all.first <= CapsuleBlocks::dense ? all : Buckets::Run{0, 0};
    });
    for (std::uint32_t k = 0;; ++k) {
      if (warp_.ballot([&](std::uint32_t lane) { return k < run[lane].end - run[lane].first; }) == 0) return;
      const auto id = warp_.each([&](std::uint32_t lane) {
        return k < run[lane].end - run[lane].first ? blocks_.id[run[lane].first + k] : 0u;
      });
      std::uint32_t near = warp_.ballot([&](std::uint32_t lane) {
        return k < run[lane].end - run[lane].first && (id[lane] & 31) == level &&
               !blocks_.crowded(id[lane] >> 5) && !blocks_.settled(b, id[lane] >> 5) &&
               !separate(own, blocks_.capsule[id[lane] >> 5], own_units);
      });
      for (; near != 0; near &= near - 1) {
        const std::uint32_t other = warp_.from(id, lowest_bit(near)) >> 5;
        compare_two<Tests>(b < other ? b : other, b < other ? other : b, sink);
      }
    }
  }

  template <class Tests, class Sink>
  CATENA_HD void compare_within(std::uint32_t b, Sink& sink) const {
    const auto all = spheres(b);
    constexpr std::uint32_t size = CapsuleBlocks::block, half = size / 2;
    const auto pair = [b](std::uint32_t ahead, std::uint32_t lane) {
      const std::uint32_t k = (lane + ahead) % size;
      return Pair{b * size + (lane < k ? lane : k), b * size + (lane < k ? k : lane)};
    };
    const auto asked = [&](std::uint32_t ahead, std::uint32_t lane) {
      return (ahead < half || lane < half) && pair(ahead, lane).j < chain_.size;
    };
    auto near = none();
    for (std::uint32_t ahead = 1; ahead <= half;
         ++ahead) {  // around the block, so that all lanes have a pair
      const auto others = warp_.shifted(all, ahead);
      near = warp_.each([&](std::uint32_t lane) {
        if constexpr (listens<Sink>)
          if (asked(ahead, lane)) sink.compared(pair(ahead, lane).i, pair(ahead, lane).j);
        return near[lane] | sign(Tests::excess(all[lane], others[lane])) << ahead;
      });
    }
    auto times = none();
    for (std::uint32_t steps = warp_.any(near); steps != 0; steps &= steps - 1) {
      const std::uint32_t ahead = lowest_bit(steps);
      const auto others = warp_.shifted(all, ahead);
      const std::uint32_t hits = warp_.ballot([&](std::uint32_t lane) {
        return (near[lane] >> ahead & 1) != 0 && asked(ahead, lane) &&
               collide<Tests>(pair(ahead, lane), all[lane], others[lane]);
      });
      if (hits == 0) continue;
      sink.collide(hits, [&](std::uint32_t lane) { return pair(ahead, lane); });
      times = warp_.each([&](std::uint32_t lane) {
        return times[lane] + (hits >> lane & 1) + (hits >> (lane + size - ahead) % size & 1);
      });
    }
    count(b, times, sink);
  }

  /// Neighbours are known first: where tubes are drawn tightest they touch to the last bit, and that is the
  /// dearest to decide.
  template <class Tests>
  CATENA_HD bool collide(const Pair& pair, const Sphere& a, const Sphere& b) const {
    return Tests::overlap_unless(chain_.neighbours(pair.i, pair.j), a, b);
  }
  CATENA_HD auto none() const {
    return warp_.each([](std::uint32_t) { return 0u; });
  }
  /// Of each sphere of block b, in how many pairs it was.
  template <class Sink>
  CATENA_HD void count(std::uint32_t b, const Lanes<std::uint32_t>& times, Sink& sink) const {
    warp_.run([&](std::uint32_t lane) {
      if (times[lane] != 0) sink.count(b * CapsuleBlocks::block + lane, times[lane]);
    });
  }
  CATENA_HD bool in_chain(std::uint32_t b, std::uint32_t k) const {
    return b * CapsuleBlocks::block + k < chain_.size;
  }
  CATENA_HD Lanes<Sphere> spheres(std::uint32_t b) const {
    return warp_.each([&](std::uint32_t lane) {
      const std::uint32_t i = b * CapsuleBlocks::block + lane;
      return chain_.spheres[i < chain_.size ? i : chain_.size - 1];
    });
  }

  /// Which spheres of block b a capsule may collide with.
  CATENA_HD std::uint32_t near(std::uint32_t b, const Lanes<Sphere>& of_b,
                               const BlockCapsule& capsule) const {
    return warp_.ballot([&](std::uint32_t lane) {
      const BlockCapsule ball = BlockCapsule::around(blocks_.scaled(of_b[lane]), own_units);
      return in_chain(b, lane) && !separate(ball, capsule, own_units);
    });
  }

  template <class Tests, class Sink>
  CATENA_HD void compare_spheres(std::uint32_t a, const Lanes<Sphere>& first, std::uint32_t of_a,
                                 std::uint32_t b, const Lanes<Sphere>& second, std::uint32_t of_b,
                                 Sink& sink) const {
    const auto pair = [a, b](std::uint32_t k, std::uint32_t lane) {
      return Pair{a * CapsuleBlocks::block + lane, b * CapsuleBlocks::block + k};
    };
    auto near = none();
    for (; of_b != 0; of_b &= of_b - 1) {
      const std::uint32_t k = lowest_bit(of_b);
      const Sphere other = warp_.from(second, k);
      near = warp_.each([&](std::uint32_t lane) {
        if constexpr (listens<Sink>)
          if ((of_a >> lane & 1) != 0) sink.compared(pair(k, lane).i, pair(k, lane).j);
        return near[lane] | sign(Tests::excess(first[lane], other)) << k;
      });
    }
    near = warp_.each([&](std::uint32_t lane) { return (of_a >> lane & 1) != 0 ? near[lane] : 0u; });
    auto times_a = none(), times_b = none();
    for (std::uint32_t left = warp_.any(near); left != 0; left &= left - 1) {
      const std::uint32_t k = lowest_bit(left);
      const Sphere other = warp_.from(second, k);
      const std::uint32_t hits = warp_.ballot([&](std::uint32_t lane) {
        return (near[lane] >> k & 1) != 0 && collide<Tests>(pair(k, lane), first[lane], other);
      });
      if (hits == 0) continue;
      sink.collide(hits, [&](std::uint32_t lane) { return pair(k, lane); });
      times_a = warp_.each([&](std::uint32_t lane) { return times_a[lane] + (hits >> lane & 1); });
      times_b = warp_.each([&](std::uint32_t lane) { return lane == k ? count_bits(hits) : times_b[lane]; });
    }
    count(a, times_a, sink);
    count(b, times_b, sink);
  }

  /// Spheres next to one another, of an ordered block and the first of the next.
  template <class Tests, class Sink>
  CATENA_HD void compare_adjacent(std::uint32_t b, Sink& sink) const {
    const bool left_out = blocks_.crowded(b), last_too = !left_out || !blocks_.crowded(b + 1);
    const auto pair = [b](std::uint32_t lane) {
      const std::uint32_t i = b * CapsuleBlocks::block + lane;
      return Pair{i, i + 1};
    };
    const std::uint32_t hits = warp_.ballot([&](std::uint32_t lane) {
      if (lane == CapsuleBlocks::block - 1 ? !last_too : left_out) return false;
      const auto [i, j] = pair(lane);
      if constexpr (listens<Sink>) sink.compared(i, j);
      return Tests::overlap(chain_.spheres[i], chain_.spheres[j]) && !chain_.neighbours(i, j);
    });
    if (hits == 0) return;
    sink.collide(hits, pair);
    warp_.run([&](std::uint32_t lane) {
      if ((hits >> lane & 1) == 0) return;
      sink.count(pair(lane).i, 1);
      sink.count(pair(lane).j, 1);
    });
  }

  const Warp& warp_;
  const ChainView& chain_;
  const CapsuleBlocks& blocks_;
};

}  // namespace catena
