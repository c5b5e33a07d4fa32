#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/core/hierarchy/sphere_bounds_visitor.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/shown_bounds.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/testing/certified.h"
#include "catena/properties/testing/no_device.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"

namespace catena::properties {
namespace {

/// What only a device can get wrong: result buffers, memory, and the bits of its trees.
class Device : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = no_device()) GTEST_SKIP() << *why;
  }
};

Chain scene(const std::string& spec) {
  const Input input = open_input(spec);
  return input.animation->frame(input.animation->frames() / 2);
}

/// Every node of a tree with its bits.
class Nodes final : public SphereBoundsVisitor {
 public:
  void sphere(std::uint32_t parent, const Sphere64& p, std::uint32_t child, const Sphere64& c) override {
    const auto bits = [](const Sphere64& s) { return std::tuple(s.x, s.y, s.z, s.radius); };
    nodes[{parent, child}] = {bits(p), bits(c)};
  }
  using Bits = std::tuple<double, double, double, double>;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<Bits, Bits>> nodes;
};

auto tree_of(const std::string& variant, const Chain& chain) {
  const auto v = StrategyRegistry::instance().make(variant);
  v->build(chain);
  Nodes nodes;
  v->visit_bounds(nodes);
  return nodes.nodes;
}

TEST_F(Device, TreesHaveTheHostsBits) {
  for (const char* input :
       {"path1:n=1000", "yarn:n=2048", "walk:n=1537", "coil:n=1200,offset=1e6", "rod:n=900,scale=1e30",
        "hair:n=1100,scale=1e-30", "rod:n=1", "rod:n=2", "rod:n=385"}) {
    const Chain chain = scene(input);
    for (const char* arithmetic : {"", "/literal"}) {
      const std::string end = arithmetic;
      const bool comparable =
          end.empty() || std::string(input).find("scale") == std::string::npos;  // NaN != NaN
      if (!comparable) continue;
      EXPECT_EQ(tree_of("aGPU2+CPU2" + end, chain), tree_of("aGPU2@host+CPU2" + end, chain)) << input << end;
      EXPECT_EQ(tree_of("bGPU2+CPU2" + end, chain), tree_of("aCPU2+CPU2" + end, chain)) << input << end;
      EXPECT_EQ(tree_of("aGPU2(subtree=6,block=2)+CPU2" + end, chain),
                tree_of("aGPU2@host(subtree=6,block=2)+CPU2" + end, chain))
          << input << end;
    }
  }
}

/// What a search says, in any order, as it accounts for pairs without one.
class Lines final : public EvidenceSink {
 public:
  void discarded(std::uint32_t a, std::uint32_t b) override { add('d', a, b); }
  void tested(std::uint32_t i, std::uint32_t j) override { add('t', i, j); }
  void excluded(std::uint32_t i, std::uint32_t j) override { add('e', i, j); }
  auto sorted() && {
    std::ranges::sort(lines_);
    return std::move(lines_);
  }

 private:
  void add(char kind, std::uint32_t a, std::uint32_t b) {
    lines_.emplace_back(kind, std::min(a, b), std::max(a, b));
  }
  std::vector<std::tuple<char, std::uint32_t, std::uint32_t>> lines_;
};

/// The blocks and cells that the device built say what the host's do: the same parts given up, the same
/// partners, the same cells, and so the same lines; and the same pairs. Cells have the same bits; capsules
/// need not, as a device rounds once where the host rounds twice (mul_add), so that those of each are
/// certified by themselves.
TEST_F(Device, BlocksAndCellsSayWhatTheHostsDo) {
  struct Twins {
    const char *device, *host;
    bool same_bits;
  };
  for (const auto& [device, host, same_bits] :
       {Twins{"DeviceGrid", "DeviceGrid@host", true}, Twins{"DeviceGrid(binned=0)", "DeviceGrid@host", true},
        Twins{"DeviceHybrid(least=0,cells=0)", "DeviceHybrid@host", false},
        Twins{"DeviceHybrid(least=0)", "DeviceHybrid@host(cells=4194304)", false},
        Twins{"DeviceHybrid(least=0,cells=0,crowd=1)", "DeviceHybrid@host(crowd=1)", false},
        Twins{"DeviceHybrid(least=0,cells=0,survey=0)", "DeviceHybrid@host(survey=0)", false},
        Twins{"DeviceHybrid", "DeviceHybrid@host(least=300000)", false},
        Twins{"DeviceCapsules", "DeviceCapsules@host", false},
        Twins{"DeviceCapsules(crowd=1)", "DeviceCapsules@host(crowd=1)", false},
        Twins{"DeviceTree", "DeviceTree@host", false}})
    for (const char* input : {"path1:n=4000", "yarn:n=5000", "mixed_radii:n=3000", "hair:n=3000",
                              "stretched:n=5000", "walk:n=20000", "coil:n=1200,offset=1e6", "points:n=3000",
                              "cluster:n=2000", "rod:n=900,scale=1e30", "rod:n=1", "rod:n=33"}) {
      const Chain chain = scene(input);
      const auto there = StrategyRegistry::instance().make(device),
                 here = StrategyRegistry::instance().make(host);
      there->build(chain), here->build(chain);
      const ShownBounds built = ShownBounds::of_evidence(*there, chain),
                        twin = ShownBounds::of_evidence(*here, chain);
      EXPECT_EQ(built.edges(), twin.edges()) << device << ", " << input;
      if (const auto difference = built.difference(twin); same_bits && difference)
        ADD_FAILURE() << device << ", " << input << ": " << *difference;
      Lines told, expected;
      Collisions shown, found, twins;
      there->find_with_evidence(chain, {}, shown, told);
      here->find_with_evidence(chain, {}, twins, expected);
      EXPECT_TRUE(std::move(told).sorted() == std::move(expected).sorted()) << device << ", " << input;
      there->find(chain, {}, found);
      for (Collisions* of : {&shown, &found, &twins}) sort(of->pairs);
      EXPECT_EQ(shown.pairs, twins.pairs) << device << ", " << input;
      EXPECT_EQ(found.pairs, twins.pairs) << device << ", " << input;
      EXPECT_EQ(found.count, twins.count) << device << ", " << input;
    }
}

TEST_F(Device, IsCertifiedByWhatItBuilt) {
  for (const char* name : {"DeviceGrid", "DeviceGrid(binned=0)", "DeviceHybrid(least=0,cells=0)",
                           "DeviceHybrid(least=0,cells=0,survey=0)", "DeviceHybrid(least=0)", "DeviceHybrid",
                           "DeviceLBVH", "DeviceCapsules", "DeviceTree"})
    expect_certified(name);
}

TEST_F(Device, PairBufferGrowsAndLosesNothing) {
  const Chain chain(
      std::vector<Sphere>(3000, Sphere{1, 2, 3, 4}));  // 4.5 million pairs, far past the first guess
  const auto exact = reference::find(chain);
  for (const char* name : {"GPU1", "aGPU2+GPU2", "aGPU2+GPUv2", "aCPU2+GPU2", "DeviceGrid", "DeviceHybrid",
                           "DeviceHybrid(least=0,cells=0)", "DeviceLBVH", "DeviceCapsules", "DeviceTree",
                           "DeviceParts(parts=3,group=4)"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    Collisions found;
    for (int round = 0; round < 2; ++round) {
      variant->build(chain);
      variant->find(chain, {}, found);
      EXPECT_TRUE(reference::compare(chain, exact, found).right()) << name;
    }
  }
}

/// Whatever the order in which blocks of threads come: sizes at the borders of blocks, teams and thread
/// blocks.
TEST_F(Device, FindsTheSamePairsEveryTime) {
  const int rounds = 40;
  for (const char* kind : {"yarn", "mixed_radii", "path1"})
    for (const std::uint32_t n : {31u, 32u, 33u, 127u, 129u, 1023u, 1025u, 4097u, 20001u}) {
      const Chain chain = scene(std::string(kind) + ":n=" + std::to_string(n));
      const auto exact = reference::find(chain);
      for (const char* name :
           {"DeviceGrid", "DeviceGrid(binned=0)", "DeviceHybrid", "DeviceHybrid(least=0)",
            "DeviceHybrid(least=0,cells=0)", "DeviceHybrid(least=0,crowd=0)",
            "DeviceHybrid(least=0,cells=0,survey=0)", "DeviceHybrid(least=0,cells=0,crowd=1,binned=0)",
            "DeviceLBVH", "DeviceCapsules", "DeviceTree", "DeviceParts(parts=3,group=4,searches=3)",
            "DeviceParts(parts=5,group=8,order=space)"}) {
        const auto variant = StrategyRegistry::instance().make(name);
        Collisions found;
        for (int round = 0; round < rounds; ++round) {
          variant->build(chain);
          variant->find(chain, {}, found);
          ASSERT_TRUE(reference::compare(chain, exact, found).right())
              << name << " on " << kind << ", n " << n;
        }
      }
    }
}

TEST_F(Device, MovesLargeChainsAndAnswersWhole) {
  // Beyond what the driver moves before memory is pinned for it, in parts of several chunks and a rest.
  std::vector<Sphere> spheres;
  for (int i = 0; i < 1'500'007; ++i)
    spheres.push_back({static_cast<float>(i % 1000), static_cast<float>(i / 1000 % 40),
                       static_cast<float>(i / 40'000), 0.55f});
  const Chain chain(spheres);
  for (const char* name : {"DeviceGrid", "aGPU2+GPU2", "aGPU2+GPUv2", "aCPU2+GPU2", "DeviceParts(memory=64)",
                           "DeviceParts(memory=64,order=space)"}) {
    const auto variant = StrategyRegistry::instance().make(name),
               host = StrategyRegistry::instance().make("Grid");
    Collisions found, expected;
    for (int frame = 0; frame < 3; ++frame) {
      for (std::size_t i = 0; i < spheres.size(); i += 1 + i % 7) spheres[i].x += 0.25f;
      const Chain moved = chain.moved(spheres);
      host->build(moved), host->find(moved, {}, expected);
      ASSERT_GT(expected.pair_count, 1'000'000u);
      variant->build(moved), variant->find(moved, {}, found);
      sort(found.pairs), sort(expected.pairs);
      EXPECT_EQ(found.pairs, expected.pairs) << name << ", frame " << frame;
      EXPECT_EQ(found.count, expected.count) << name << ", frame " << frame;
      variant->find(moved, {.want = Request::Want::counts}, found);  // none leaves as others have found some
      EXPECT_EQ(found.pair_count, expected.pair_count) << name << ", frame " << frame;
      EXPECT_EQ(found.count, expected.count) << name << ", frame " << frame;
    }
  }
}

/// What moved alone goes to the device: ranges that are moved together, as they lie near one another, ranges
/// that are not, and a single one.
TEST_F(Device, MovesTheRangesThatMoved) {
  const Chain chain = scene("path1:n=20000");
  const std::uint32_t n = chain.size();
  for (const std::vector<SphereRange>& ranges :
       {std::vector<SphereRange>{{0, 1}, {1000, 1003}, {7000, 7001}, {9500, 9600}, {n - 1, n}},
        {{5000, 5002}},
        {}})
    for (const char* name : {"DeviceGrid", "DeviceHybrid(least=0)", "DeviceLBVH", "DeviceCapsules",
                             "DeviceTree", "aGPU2+GPU2", "aCPU2+GPU2", "DeviceGrid(upload=all,range=checked)",
                             "DeviceHybrid(least=0,upload=all,strands=read,range=checked)"}) {
      std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
      for (const SphereRange& range : ranges)
        for (std::uint32_t i = range.begin; i < range.end; ++i) spheres[i] = chain[(i + n / 2) % n];
      const Chain moved = chain.moved(std::move(spheres));
      const auto before = reference::find(chain), after = reference::find(moved);
      ASSERT_EQ(before.pairs == after.pairs, ranges.empty());
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->update(moved, Moved(ranges));
      variant->find(moved, {}, found);
      EXPECT_TRUE(reference::compare(moved, after, found).right())
          << name << ", " << ranges.size() << " ranges";
      variant->update(chain, Moved(ranges));
      variant->find(chain, {}, found);
      EXPECT_TRUE(reference::compare(chain, before, found).right()) << name << ", and back";
    }
}

TEST_F(Device, PairLimitIsAnErrorWithTheTrueNumber) {
  const Chain chain(std::vector<Sphere>(3000, Sphere{1, 2, 3, 4}));
  const std::uint64_t expected = 3000ull * 2999 / 2 - 2999;
  for (const char* name : {"GPU1", "aGPU2+GPU2", "aGPU2+GPUv2", "DeviceGrid", "DeviceGrid(binned=0)",
                           "DeviceHybrid", "DeviceHybrid(least=0,cells=0)", "DeviceLBVH", "DeviceCapsules",
                           "DeviceTree", "DeviceParts(parts=3,group=4)"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    variant->build(chain);
    Collisions found;
    for (std::uint64_t limit : {std::uint64_t{0}, std::uint64_t{1}, expected - 1}) {
      try {
        variant->find(chain, {Request::Want::pairs, limit}, found);
        ADD_FAILURE() << name << " accepted a flood at limit " << limit;
      } catch (const PairLimitExceeded& error) {
        EXPECT_EQ(error.found(), expected) << name;
        EXPECT_TRUE(found.pairs.empty()) << name;
      }
    }
    variant->find(chain, {Request::Want::pairs, expected}, found);
    EXPECT_EQ(found.pairs.size(), expected) << name;
    variant->find(chain, {Request::Want::counts}, found);
    EXPECT_EQ(found.pair_count, expected) << name;
    variant->find(chain, {Request::Want::any}, found);
    EXPECT_TRUE(found.found) << name;
  }
}

/// So many spheres that their pairs, when all coincide, take a quarter more than all memory of device 0.
std::size_t too_many_to_keep_all_pairs() {
  const double bytes = std::stod(environment().at("gpu memory")) * (1 << 20);  // given in MiB
  return static_cast<std::size_t>(std::sqrt(2 * 1.25 * bytes / sizeof(Pair)));
}

TEST_F(Device, OutOfMemoryNamesNeedAndSupply) {
  const Chain chain(std::vector<Sphere>(too_many_to_keep_all_pairs(), Sphere{0, 0, 0, 1}));
  const auto variant = StrategyRegistry::instance().make("aGPU2+GPU2");
  variant->build(chain);
  Collisions found;
  try {
    variant->find(chain, {Request::Want::pairs, std::numeric_limits<std::uint64_t>::max()}, found);
    FAIL() << found.pairs.size() << " pairs were stored";
  } catch (const CapacityError& error) {
    EXPECT_NE(std::string(error.what()).find("out of device memory"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("are needed"), std::string::npos) << error.what();
  }
  variant->find(chain, {Request::Want::any}, found);  // the strategy is usable afterwards
  EXPECT_TRUE(found.found);
}

TEST_F(Device, BlockPastTheLimitPointsToTheUnlimitedStrategy) {
  const auto variant = StrategyRegistry::instance().make("bGPU2(block=64)+GPU2");
  try {
    variant->build(scene("rod:n=129"));
    FAIL();
  } catch (const CapacityError& error) {
    EXPECT_NE(std::string(error.what()).find("at most 128"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("use aGPU2"), std::string::npos) << error.what();
  }
}

TEST_F(Device, EveryExclusionRuleTravels) {
  auto rule = Exclusion::index(3);
  rule.extra_pairs = {{0, 40}, {10, 70}, {80, 89}};  // of the last sphere, too
  std::vector<Sphere> spheres;
  for (int i = 0; i < 90; ++i) spheres.push_back({float(i % 9), float(i / 9), float(i % 3), 1.5f});
  const Strands strands{{0, 30, 60, 90}, {1, 0, 1}};
  auto arcs = Exclusion::arc(1.3);
  arcs.extra_pairs = rule.extra_pairs;
  for (const Chain& chain :
       {Chain(spheres, strands, rule), Chain(spheres, strands, arcs), Chain(spheres, {}, arcs)}) {
    const auto exact = reference::find(chain);
    ASSERT_GT(exact.pair_count, 100u);
    for (const char* name : {"GPU1", "aGPU2+GPU2", "aGPU2+GPUv2", "bGPU2+CPU2", "aCPU2+GPUv2", "DeviceGrid",
                             "DeviceGrid(binned=0)", "DeviceHybrid", "DeviceHybrid(least=0,cells=0)",
                             "DeviceHybrid(least=0,strands=read)", "DeviceGrid(strands=read,range=checked)",
                             "DeviceLBVH", "DeviceCapsules", "DeviceTree", "DeviceParts(parts=3,group=4)"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      EXPECT_TRUE(reference::compare(chain, exact, found).right()) << name;
    }
  }
}

TEST_F(Device, AMillionSpheres) {
  for (const char* input : {"path1:n=1000000", "path2:n=1000000"}) {
    const Chain chain = scene(input);
    const auto exact = reference::find(chain);
    ASSERT_EQ(exact.pair_count, 45u);
    for (const char* name :
         {"aGPU2+GPU2", "aGPU2+GPUv2", "aCPU2+GPU2", "aGPU2+CPU2", "DeviceGrid", "DeviceHybrid",
          "DeviceHybrid(least=0,cells=0)", "DeviceHybrid(survey=0)", "DeviceHybrid(cells=0,crowd=0)",
          "DeviceLBVH", "DeviceCapsules", "DeviceTree", "DeviceParts(parts=3,group=4)"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      EXPECT_TRUE(reference::compare(chain, exact, found).right()) << name << " on " << input;
    }
  }
}

}  // namespace
}  // namespace catena::properties
