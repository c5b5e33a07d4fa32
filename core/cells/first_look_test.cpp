#include "catena/core/cells/first_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/host_blocks.h"
#include "catena/core/executor/host_group.h"

namespace catena {
namespace {

using Places = std::set<std::uint32_t>;  // of the blocks that are asked

/// Blocks of 32 spheres in a row, each at a place of its own, far from the others, unless it is put
/// elsewhere.
class Blocks {
 public:
  explicit Blocks(std::uint32_t blocks, float least_radius = 0.25f) : blocks_(blocks) {
    for (std::uint32_t b = 0; b < blocks; ++b)
      for (std::uint32_t k = 0; k < CapsuleBlocks::block; ++k)
        sphere_.push_back({static_cast<float>(k), 64.0f * static_cast<float>(b), 0, 0.25f});
    sphere_.back().radius = least_radius;
    laid_out_ = CapsuleBlocks::of(view(), 8, block_scale(view().extent), 0, ~0u, 64);
  }
  /// Beside where another block is, so that they touch, or not.
  Blocks& put(std::uint32_t b, std::uint32_t at, float beside = 0.25f) {
    for (std::uint32_t k = 0; k < CapsuleBlocks::block; ++k)
      sphere_[b * CapsuleBlocks::block + k].y = 64.0f * static_cast<float>(at) + (b > at ? beside : -beside);
    return *this;
  }
  /// Into an arc, whose middle lies so far beside its ends.
  Blocks& bend(std::uint32_t b, float height) {
    for (std::uint32_t k = 0; k < CapsuleBlocks::block; ++k)
      sphere_[b * CapsuleBlocks::block + k].y +=
          height * (1 - std::pow(static_cast<float>(k) / 15.5f - 1, 2.0f));
    return *this;
  }
  Blocks& fold(std::uint32_t b) {
    std::swap(sphere_[b * CapsuleBlocks::block + 9].x, sphere_[b * CapsuleBlocks::block + 21].x);
    return *this;
  }
  std::uint32_t asked(std::uint32_t k) const { return laid_out_.block_asked(k); }
  /// The first of four from there on, of which one is looked at, and none is asked, or next to one that is.
  std::uint32_t four_not_asked(std::uint32_t four) const {
    for (std::uint32_t k = 0; k < FirstLook::asked; ++k)
      if (asked(k) + 1 >= four && asked(k) <= four + 4) four += 4, k = ~0u;
    return four;
  }
  const CapsuleBlocks& laid_out() const { return laid_out_; }

  /// What all that look see, whatever the threads of a group.
  CapsuleBlocks::Look seen(std::uint32_t threads = 32) const {
    CapsuleBlocks::Look look{};
    CapsuleBlocks blocks = laid_out_;
    blocks.look = &look;
    FirstLook::Memory memory;
    for (std::uint32_t k = 0; k < FirstLook::groups(blocks); ++k)
      FirstLook(view(), blocks, memory).look(HostGroup(threads), k);
    return look;
  }
  Places met(std::uint32_t threads = 32) const { return places(seen(threads).met); }
  static Places places(const std::uint32_t (&word)[CapsuleBlocks::Look::words]) {
    Places result;
    for (std::uint32_t k = 0; k < FirstLook::asked; ++k)
      if ((word[k / 32] >> k % 32 & 1) != 0) result.insert(k);
    return result;
  }
  /// What was said in place of the survey once blocks were enclosed.
  CapsuleBlocks::Survey said(HostBlocks& host) const {
    return CapsuleBlocks::Survey::of(host.enclose(view(), laid_out_).state->survey);
  }
  ChainView view() const {
    ChainView chain{};
    chain.spheres = sphere_.data(), chain.size = static_cast<std::uint32_t>(sphere_.size());
    chain.strand_count = 1, chain.exclusion.rule = Exclusion::Rule::index_window, chain.exclusion.window = 1;
    chain.extent = {sphere_.back().radius, 0.25f, 64.0 * blocks_, 64.0f * static_cast<float>(blocks_)};
    return chain;
  }

 private:
  std::uint32_t blocks_;
  std::vector<Sphere> sphere_;
  CapsuleBlocks laid_out_{};
};

constexpr std::uint32_t many = 1000;

TEST(FirstLook, MeetsNobodyWhereAllAreApart) {
  for (const std::uint32_t blocks : {256u, 257u, 319u, 320u, many})
    EXPECT_TRUE(Blocks(blocks).met().empty()) << blocks;
}

/// Of four that follow one another each is asked about one.
TEST(FirstLook, SeesWhoMeetsOneOfFour) {
  Blocks blocks(many);
  const Places those = {0, 5, 31, 32, 40, 63};
  std::uint32_t four = 0;
  for (const std::uint32_t k : those) {
    four = blocks.four_not_asked(four + 4);
    for (std::uint32_t b = four; b < four + 4; ++b) blocks.put(b, blocks.asked(k));
  }
  for (const std::uint32_t threads : {1u, 32u, 128u}) EXPECT_EQ(blocks.met(threads), those) << threads;
}

/// Wherever it begins: among those that are near, and apart, it finds the one that is met.
TEST(FirstLook, GoesOnBehindOneThatIsNear) {
  for (std::uint32_t near = 0; near < 32; ++near) {
    const std::uint32_t met = (near + 16) % 32;
    Blocks blocks(many);
    const std::uint32_t four = blocks.four_not_asked(400);
    blocks.put(blocks.asked(near), four, 5).put(blocks.asked(met), four);
    for (std::uint32_t b = four; b < four + 4; ++b) blocks.put(b, four);
    EXPECT_EQ(blocks.met(), (Places{met})) << near;
  }
}

TEST(FirstLook, HoldsTheMiddleOfAnArc) {
  Blocks blocks(many);
  const std::uint32_t four = blocks.four_not_asked(400);
  blocks.bend(blocks.asked(9), 4);
  for (std::uint32_t b = four; b < four + 4; ++b) blocks.put(b, blocks.asked(9), 4.25f);
  EXPECT_EQ(blocks.met(), (Places{9}));
}

/// Also the last group's, whose share is not full.
TEST(FirstLook, SeesTheLastBlocks) {
  for (const std::uint32_t all : {256u, 260u, 516u, many}) {
    Blocks blocks(all);
    for (std::uint32_t b = all - 4; b < all; ++b) blocks.put(b, blocks.asked(7));
    EXPECT_TRUE(blocks.met().contains(7)) << all;
  }
}

/// Which it touches whatever the chain does.
TEST(FirstLook, DoesNotCountWhoIsNext) {
  Blocks blocks(many);
  for (std::uint32_t k = 0; k < FirstLook::asked; ++k)
    for (const std::uint32_t b : {blocks.asked(k) - 1, blocks.asked(k) + 1})
      if (b < many) blocks.put(b, blocks.asked(k));
  EXPECT_TRUE(blocks.met().empty());
}

/// Many near ones, of which each is looked at by a few only, are all seen by all together.
TEST(FirstLook, SeesAllInACrowd) {
  Blocks blocks(many);
  for (std::uint32_t b = 1; b < many; ++b) blocks.put(b, 0);
  EXPECT_EQ(blocks.met().size(), FirstLook::asked);
}

TEST(FirstLook, IsToldWhoGoesOnInNoOrder) {
  Blocks blocks(many);
  const Places those = {0, 31, 32, 63};
  for (const std::uint32_t k : those) blocks.fold(blocks.asked(k));
  for (std::uint32_t k = 0; k < FirstLook::asked; ++k) blocks.fold(blocks.asked(k) + 2);  // not asked
  HostBlocks host;
  const CapsuleBlocks::Look& look = *host.enclose(blocks.view(), blocks.laid_out()).look;
  EXPECT_EQ(Blocks::places(look.tangled), those);
  EXPECT_TRUE(Blocks::places(look.met).empty());
}

TEST(FirstLook, IsOnlyTakenWhereASurveyWouldBeAndPays) {
  const auto pays = [](const ChainView& chain, std::uint32_t surveyed) {
    return FirstLook::pays(CapsuleBlocks::of(chain, 8, block_scale(chain.extent), 0, 0, surveyed));
  };
  EXPECT_TRUE(pays(Blocks(256).view(), 64));
  EXPECT_TRUE(pays(Blocks(256).view(), 1));
  EXPECT_FALSE(pays(Blocks(255).view(), 64));
  EXPECT_FALSE(pays(Blocks(256).view(), 0));
  EXPECT_TRUE(pays(Blocks(256, 0.25f / 64).view(), 64));
  EXPECT_FALSE(pays(Blocks(256, 0.25f / 65).view(), 64));  // radii are unlike
  ChainView wide = Blocks(256).view();
  wide.extent.sides = wide.extent.greatest_coordinate = 1e11f;
  EXPECT_TRUE(CapsuleBlocks::of(wide, 8, block_scale(wide.extent), 0, 0, 64).own_units);
  EXPECT_FALSE(pays(wide, 64));
}

/// And of the next chain nothing is known.
TEST(FirstLook, SpeaksForTheSurveyAndForgets) {
  Blocks crowd(many);
  const Blocks apart(many);
  for (std::uint32_t b = 1; b < many; ++b) crowd.put(b, 0);
  HostBlocks host;
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(crowd.said(host).asked, 64u);
    EXPECT_TRUE(host.blocks().surveyed_all());
    EXPECT_TRUE(host.blocks().all_left());
    EXPECT_EQ(apart.said(host).number(), 0u);
    EXPECT_FALSE(host.blocks().surveyed_all());
    EXPECT_FALSE(host.blocks().all_left());
  }
}

/// The first `met` met somebody, and `tangled` are in no order, from the `from`-th on.
TEST(FirstLook, LeavesAllByWhatItSaw) {
  struct Case {
    std::uint32_t met, tangled, from, many, looked;
    bool left;
  };
  for (const Case& c : {
           Case{0, 0, 0, 38, 4, false},
           Case{39, 0, 0, 38, 4, false},
           Case{40, 0, 0, 38, 4, true},
           Case{40, 0, 0, 64, 38, true},
           Case{0, 64, 0, 38, 4, false},  // two each
           Case{8, 64, 0, 38, 4, false},
           Case{9, 64, 0, 38, 4, true},  // 128 + 36 of 2.5 each, 160
           Case{9, 64, 0, 64, 4, false},
           Case{39, 64, 0, 64, 4, true},  // of 4.1 each, 264
           Case{34, 64, 0, 64, 4, false},
           Case{35, 64, 0, 64, 4, true},
           Case{5, 64, 0, 38, 8, true},
           Case{5, 64, 0, 38, 9, false},  // too few others
           Case{32, 32, 0, 38, 4, false},
           Case{32, 32, 13, 38, 4, false},
           Case{32, 32, 14, 38, 4, true},
       }) {
    CapsuleBlocks::Look look{};
    for (std::uint32_t k = 0; k < c.met; ++k) look.met[k / 32] |= 1u << k % 32;
    for (std::uint32_t k = c.from; k < c.from + c.tangled; ++k) look.tangled[k / 32] |= 1u << k % 32;
    CapsuleBlocks blocks{};
    blocks.many_partners = c.many, blocks.looked = c.looked, blocks.look = &look;
    EXPECT_EQ(blocks.left_at_first_look(), c.left)
        << c.met << ' ' << c.tangled << ' ' << c.from << ' ' << c.many;
    blocks.look = nullptr;
    EXPECT_FALSE(blocks.left_at_first_look());
  }
}

}  // namespace
}  // namespace catena
