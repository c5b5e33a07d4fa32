#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/properties/testing/random_spheres.h"

// One thread sorts what is beyond its cache part by part; several threads by one counting sort.
namespace catena {
namespace {

TEST(PartedSort, PutsEachSphereWhereOneCountingSortPutsIt) {
  const Team alone, several(Parameters("test", {Team::threads_parameter()}, "threads=3"));
  for (const float volume : {1.5f, 60.0f})
    for (const std::uint32_t each : {1u, 3u})
      for (const bool wide : {false, true}) {
        std::mt19937 dice(11);
        const Chain chain(properties::spheres_in_volume(300'000, volume, dice));
        std::vector<std::uint32_t> only;
        if (each > 1)
          for (std::uint32_t i = 0; i < chain.size(); i += each) only.push_back(i);
        SphereGrid parted, whole;
        parted.wide = whole.wide = wide;
        build_grid(chain.view(), parted, only, alone);
        build_grid(chain.view(), whole, only, several);
        ASSERT_EQ(parted.levels.size(), 1u);
        ASSERT_TRUE(parted.start == whole.start) << volume << ' ' << each << ' ' << wide;
        const std::uint32_t buckets = parted.levels[0].map.buckets;
        ASSERT_EQ(parted.start[buckets], each > 1 ? only.size() : chain.size());
        for (std::uint32_t b = 0; b < buckets; ++b) {
          const auto first = parted.index.begin() + parted.start[b],
                     end = parted.index.begin() + parted.start[b + 1];
          ASSERT_TRUE(std::is_sorted(first, end)) << "the order of the chain within a bucket";
          ASSERT_TRUE(std::is_permutation(first, end, whole.index.begin() + whole.start[b]));
        }
        for (std::uint32_t p = 0; p < parted.spheres(); ++p) {
          const Sphere& s = chain.spheres()[parted.index[p]];
          ASSERT_TRUE(parted.x[p] == s.x && parted.y[p] == s.y && parted.z[p] == s.z);
        }
      }
}

}  // namespace
}  // namespace catena
