// Sorts the spheres of each level of a grid into its buckets.
#if defined(CATENA_CORE_GRID_SORT_SPHERES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_SORT_SPHERES_INL_H
#undef CATENA_CORE_GRID_SORT_SPHERES_INL_H
#else
#define CATENA_CORE_GRID_SORT_SPHERES_INL_H
#endif

#include <algorithm>
#include <bit>
#include <numeric>

#include "catena/core/blocks/transpose-inl.h"
#include "catena/core/executor/team.h"
#include "catena/core/grid/centre_box-inl.h"
#include "catena/core/grid/member_buckets-inl.h"
#include "catena/core/grid/parted_sort-inl.h"
#include "catena/core/prefetch.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// A counting sort, which keeps the order of the chain within a bucket, but for several threads.
class SphereSort {
 public:
  SphereSort(const ChainView& chain, SphereGrid& grid, const Team& team)
      : chain_(chain), grid_(grid), team_(team) {}

  void sort(SphereGrid::Level& level) {
    if (grid_.levels.size() > 1) enclose(level);
    const auto share_out = [&](const auto& work) {
      team_.for_each_range(
          level.end - level.first, members_of_a_task,
          [&](std::uint32_t begin, std::uint32_t end) { work(level.first + begin, level.first + end); });
    };
    if (team_.size() == 1 && PartedSort::pays(chain_, grid_, level)) {
      PartedSort(chain_, grid_, level).run();
    } else {
      share_out([&](std::uint32_t begin, std::uint32_t end) { count(level, begin, end); });
      add_up(level);
      share_out([&](std::uint32_t begin, std::uint32_t end) { place(level, begin, end); });
    }
    share_out([&](std::uint32_t begin, std::uint32_t end) { copy(begin, end); });
  }

 private:
  static constexpr std::uint32_t ahead = 32;  // how far ahead memory is fetched

  void count(const SphereGrid::Level& level, std::uint32_t begin, std::uint32_t end) {
    const BucketFinder find(level.map);
    std::uint32_t* const counts = grid_.start.data() + level.starts;
    MemberBuckets members;
    const bool alone = team_.size() == 1;
    for (std::uint32_t at = begin; at < end; at += MemberBuckets::most) {
      const std::uint32_t size = std::min(MemberBuckets::most, end - at);
      members.take(chain_, grid_, at, size);
      const std::uint32_t* const buckets = members.find(find);
      for (std::uint32_t k = 0; k < size; ++k) {
        remember(at + k, {buckets[k], count_one(counts[buckets[k]], alone)});
      }
    }
  }

  /// A member's bucket, and how many came into it before; kept where coordinates will be, which costs no
  /// memory.
  struct Counted {
    std::uint32_t bucket, before;
  };
  void remember(std::uint32_t at, const Counted& of) {
    grid_.x[at] = std::bit_cast<float>(of.bucket);
    grid_.y[at] = std::bit_cast<float>(of.before);
  }
  Counted remembered(std::uint32_t at) const {
    return {std::bit_cast<std::uint32_t>(grid_.x[at]), std::bit_cast<std::uint32_t>(grid_.y[at])};
  }

  void enclose(SphereGrid::Level& level) {
    const Sphere& first = chain_.spheres[grid_.member(level.first)];
    const CentreBox one{{first.x, first.y, first.z}, {first.x, first.y, first.z}};
    level.centres = joined_by(
        team_, level.end - level.first, members_of_a_task, one, [&](std::uint32_t begin, std::uint32_t end) {
          MemberBuckets members;
          CentreBox box = one;
          for (std::uint32_t at = level.first + begin; at < level.first + end; at += MemberBuckets::most) {
            const std::uint32_t size = std::min(MemberBuckets::most, level.first + end - at);
            members.take(chain_, grid_, at, size);
            take_in(box, members.box(0, size).centres);
          }
          return box;
        });
  }

  /// Counts become places, part by part of the buckets.
  void add_up(const SphereGrid::Level& level) {
    std::uint32_t* const start = grid_.start.data() + level.starts;
    const std::uint32_t buckets = level.map.buckets + 1, parts = team_.size() == 1 ? 1 : 4 * team_.size();
    const auto first_of = [&](std::uint32_t part) {
      return static_cast<std::uint32_t>(std::uint64_t{buckets} * part / parts);
    };
    grid_.part_place.assign(parts + 1, 0);
    const auto each = [&](const auto& work) {
      team_.for_each_range(parts, 1, [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t part = begin; part < end; ++part) work(part);
      });
    };
    if (parts > 1)
      each([&](std::uint32_t part) {
        grid_.part_place[part + 1] = std::accumulate(start + first_of(part), start + first_of(part + 1), 0u);
      });
    grid_.part_place[0] = level.first;
    std::partial_sum(grid_.part_place.begin(), grid_.part_place.end(), grid_.part_place.begin());
    each([&](std::uint32_t part) {
      std::uint32_t place = grid_.part_place[part];
      for (std::uint32_t b = first_of(part), end = first_of(part + 1); b < end; ++b) {
        const std::uint32_t spheres = start[b];
        start[b] = place;
        place += spheres;
      }
    });
  }

  void place(const SphereGrid::Level& level, std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t* const start = grid_.start.data() + level.starts;
    const bool several = grid_.levels.size() > 1;
    for (std::uint32_t at = begin; at < end; ++at) {
      const Counted of = remembered(at);
      const std::uint32_t place = start[of.bucket] + of.before;
      grid_.index[place] = grid_.member(at);
      if (several) grid_.place[at] = place;
    }
  }

  void copy(std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t group = 16;
    std::uint32_t place = begin;
    for (; place + group <= end; place += group) {
      if (place + ahead + group <= end)
        for (std::uint32_t k = 0; k < group; ++k)
          prefetch(chain_.spheres + grid_.index[place + ahead + k]);
      Lanes16 field[4];
      transpose_rows([&](std::size_t k) { return &chain_.spheres[grid_.index[place + k]].x; }, field);
      field[0].store(grid_.x.data() + place), field[1].store(grid_.y.data() + place);
      field[2].store(grid_.z.data() + place), field[3].store(grid_.radius.data() + place);
    }
    for (; place < end; ++place) {
      const Sphere& s = chain_.spheres[grid_.index[place]];
      grid_.x[place] = s.x, grid_.y[place] = s.y, grid_.z[place] = s.z, grid_.radius[place] = s.radius;
    }
  }

  static constexpr std::uint32_t members_of_a_task = 8192;

  const ChainView& chain_;
  SphereGrid& grid_;
  const Team& team_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
