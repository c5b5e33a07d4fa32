#include "catena/core/input/thinned.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "catena/core/chain/bending_window.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/input/test_crooked.h"
#include "catena/core/input/tube_loss.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/vec3.h"
#include "catena/reference/reference.h"

namespace catena {
namespace {

/// Frames that are given.
class Frames final : public Animation {
 public:
  explicit Frames(std::vector<Chain> chains) : chains_(std::move(chains)) {}
  std::uint32_t frames() const override { return static_cast<std::uint32_t>(chains_.size()); }
  Chain frame(std::uint32_t f) const override { return chains_[f]; }

 private:
  std::vector<Chain> chains_;
};

/// The same, of which it is known how often each was asked for.
class Asked final : public Animation {
 public:
  explicit Asked(std::vector<Chain> chains) : times(chains.size()), chains_(std::move(chains)) {}
  std::uint32_t frames() const override { return static_cast<std::uint32_t>(chains_.size()); }
  Chain frame(std::uint32_t f) const override { return ++times[f], chains_[f]; }
  mutable std::vector<int> times;

 private:
  std::vector<Chain> chains_;
};

/// What a thinning sees that asks frame 0 alone.
class FirstFrameOnly final : public Animation {
 public:
  explicit FirstFrameOnly(const Animation& all) : all_(all) {}
  Chain frame(std::uint32_t f) const override { return all_.frame(f); }

 private:
  const Animation& all_;
};

TEST(Thin, KeepsWhatTheToleranceNeedsAndNoMore) {
  std::vector<Sphere> rod;
  for (int i = 0; i <= 1000; ++i) rod.push_back({rounded(i * 0.015625), 0, 0, 1});
  const Frames whole({Chain(rod, {}, Exclusion::arc(bending_window))});
  const Thinning thinning = thin(whole, {}, 0.01);
  const double most = 2 * std::sqrt(1 - 0.99 * 0.99);  // between kept centres
  const auto steps = static_cast<std::uint32_t>(most / 0.015625);
  EXPECT_EQ(thinning.kept.size(), (1000 + steps - 1) / steps + 1);
  EXPECT_EQ(thinning.kept.front(), 0u);
  EXPECT_EQ(thinning.kept.back(), 1000u);
  EXPECT_LE(thinning.lost, 0.01);
  EXPECT_GT(thinning.lost, 0.009);
  EXPECT_LT(thinning.own, 1e-4);
}

TEST(Thin, LosesOfATubeThatABoxCutsApartWhatItLosesWhole) {
  std::vector<Sphere> rod, cut;
  for (int i = 0; i <= 1000; ++i) {
    const float x = rounded(i * 0.015625);
    rod.push_back({x, 5, 5, 1}), cut.push_back({std::fmod(x, 10.0f), 5, 5, 1});
  }
  const Exclusion arcs = Exclusion::arc(bending_window);
  const PeriodicBox box{{10, 10, 10}};
  const Thinning whole = thin(Frames({Chain(rod, {}, arcs)}), {}, 0.01);
  const Thinning apart = thin(Frames({Chain(cut, {}, arcs)}), {}, 0.01, std::span(&box, 1));
  EXPECT_NEAR(apart.own, whole.own, 1e-6);
  EXPECT_TRUE(apart.keeps(639) && apart.keeps(640)) << "before and after the face";
  EXPECT_LE(apart.kept.size(), whole.kept.size() + 2);
}

TEST(Thin, KeepsTheEndsAloneWhereOneStretchWillDo) {
  for (std::uint32_t steps = 1; steps <= 40; ++steps) {
    std::vector<Sphere> rod;
    for (std::uint32_t i = 0; i <= steps; ++i) rod.push_back({rounded(i * 0.015625), 0, 0, 1});
    EXPECT_EQ(thin(Frames({Chain(rod, {}, Exclusion::arc(bending_window))}), {}, 0.1).kept,
              (std::vector<std::uint32_t>{0, steps}));
    if (const Pair joint{steps / 3, steps / 2}; joint.i > 0 && joint.i < joint.j) {
      EXPECT_EQ(
          thin(Frames({Chain(rod, {}, Exclusion::arc(bending_window))}), std::span(&joint, 1), 0.1).kept,
          (std::vector<std::uint32_t>{0, joint.i, joint.j, steps}));
    }
  }
}

/// What the kept spheres find is what all of them find, between those that are kept: on strands, open and
/// closed, with further neighbours, in every frame.
TEST(Thin, LeavesTheAnswerBetweenKeptSpheresAsItIs) {
  std::mt19937 random(11);
  std::uint64_t pairs = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<Chain> frames;
    for (int f = 0; f < 3; ++f) {
      std::vector<Sphere> spheres;
      for (const std::uint32_t n : {90u, 300u, 1u}) {
        const auto strand = crooked(random, n);
        spheres.insert(spheres.end(), strand.begin(), strand.end());
      }
      Exclusion exclusion = Exclusion::arc(bending_window);
      exclusion.extra_pairs = {{0, 389}, {5, 300}, {0, 390}};
      frames.push_back(f == 0 ? Chain(spheres, {{0, 90, 390, 391}, {1, 1, 0}}, exclusion)
                              : frames[0].moved(spheres));
    }
    const std::vector<Pair> joints{{45, 200}};
    const Frames whole(frames);
    const Thinning thinning = thin(whole, joints, 0.02);
    ASSERT_LT(thinning.kept.size(), 391u);
    for (const std::uint32_t stays : {0u, 45u, 89u, 90u, 200u, 389u, 390u})
      EXPECT_TRUE(std::ranges::binary_search(thinning.kept, stays)) << stays;
    const auto coarse = thinned(std::make_unique<Frames>(frames), thinning);
    ASSERT_EQ(coarse->frames(), 3u);
    for (std::uint32_t f = 0; f < 3; ++f) {
      std::vector<Pair> expected;
      for (const Pair& pair : reference::find(frames[f]).pairs) {
        const auto now = [&](std::uint32_t i) {
          return std::ranges::lower_bound(thinning.kept, i) - thinning.kept.begin();
        };
        if (std::ranges::binary_search(thinning.kept, pair.i) &&
            std::ranges::binary_search(thinning.kept, pair.j))
          expected.push_back(
              {static_cast<std::uint32_t>(now(pair.i)), static_cast<std::uint32_t>(now(pair.j))});
      }
      EXPECT_EQ(reference::find(coarse->frame(f)).pairs, expected);
      pairs += expected.size();
      for (std::size_t k = 0; k + 1 < thinning.kept.size(); ++k) {
        const std::uint32_t a = thinning.kept[k], b = thinning.kept[k + 1];
        if (b == a + 1) continue;
        const auto stretch = frames[f].spheres().subspan(a, b - a + 1);
        const float least = std::ranges::min_element(stretch, {}, &Sphere::radius)->radius;
        EXPECT_LE(tube_loss(stretch), 0.02 * least);
        EXPECT_LE(tube_loss(stretch), thinning.lost * least * (1 + 1e-15));
      }
    }
  }
  EXPECT_GT(pairs, 1000u);
}

/// A tube that is straight in one frame and bent in another keeps what the bent one needs.
TEST(Thin, AsksEveryFrame) {
  std::vector<Sphere> straight, bent;
  for (int i = 0; i <= 400; ++i) {
    straight.push_back({rounded(0.02 * i), 0, 0, 1});
    bent.push_back({rounded(2 * std::cos(0.01 * i)), rounded(2 * std::sin(0.01 * i)), 0, 1});
  }
  const Chain first(straight, {}, Exclusion::arc(bending_window));
  const std::size_t one = thin(Frames({first}), {}, 0.01).kept.size();
  for (const auto& frames : {std::vector{first, first.moved(bent)}, std::vector{first.moved(bent), first},
                             std::vector{first, first, first.moved(bent), first}}) {
    const Thinning both = thin(Frames(frames), {}, 0.01);
    EXPECT_GT(both.kept.size(), one);
    EXPECT_LE(both.lost, 0.01);
    EXPECT_GT(both.lost, 0.002);
  }
}

// What the input's own steps lose is told, of the step that closes a strand too.
TEST(Thin, TellsWhatTheWidestStepLoses) {
  for (const bool closed : {false, true}) {
    std::vector<Sphere> arc;
    for (int i = 0; i <= 300; ++i)  // all but the last bit of a ring
      arc.push_back({rounded(4 * std::cos(0.02 * i)), rounded(4 * std::sin(0.02 * i)), 0, 1});
    const Chain chain(arc, {{0, 301}, {std::uint8_t{closed}}}, Exclusion::arc(bending_window));
    const std::vector<Sphere> widest{closed ? arc[300] : arc[0], closed ? arc[0] : arc[1]};
    EXPECT_NEAR(thin(Frames({chain}), {}, 0.01).own, tube_loss(widest), 1e-6) << closed;
  }
}

/// Whatever the radii are: the greatest loss of all steps.
TEST(Thin, TellsTheGreatestLossOfAnyStep) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> radius(0.5f, 3), step(0.01f, 2);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Sphere> spheres{{0, 0, 0, radius(random)}};
    while (spheres.size() < 6) spheres.push_back({spheres.back().x + step(random), 0, 0, radius(random)});
    double most = 0;
    for (std::size_t i = 0; i + 1 < spheres.size(); ++i) {
      const std::vector<Sphere> two{spheres[i], spheres[i + 1]};
      most = std::max(most, std::min(1.0, tube_loss(two) / std::min(two[0].radius, two[1].radius)));
    }
    ASSERT_NEAR(thin(Frames({Chain(spheres, {}, Exclusion::arc(bending_window))}), {}, 0.01).own, most, 1e-9);
  }
}

// Of a pair whose other sphere is left out there is nothing to say.
TEST(Thinned, KeepsExtraPairsOfKeptSpheres) {
  std::vector<Sphere> rod;
  for (int i = 0; i <= 20; ++i) rod.push_back({rounded(i * 0.015625), 0, 0, 1});
  for (const auto& [pair, kept] :
       {std::pair(Pair{0, 20}, true), {{0, 7}, false}, {{7, 20}, false}, {{3, 7}, false}}) {
    Exclusion rule = Exclusion::arc(0.001);
    rule.extra_pairs = {pair};
    const Frames whole({Chain(rod, {}, rule)});
    const Thinning thinning = thin(whole, {}, 0.1);
    ASSERT_EQ(thinning.kept, (std::vector<std::uint32_t>{0, 20}));
    EXPECT_EQ(thinned(std::make_unique<Frames>(whole), thinning)->frame(0).exclusion().extra_pairs,
              std::vector<Pair>(kept ? 1 : 0, Pair{0, 1}));
  }
}

// Neighbours are each frame's own, where frames do not share them.
TEST(Thinned, TakesTheRuleOfEachFrame) {
  std::mt19937 random(3);
  const auto spheres = crooked(random, 100);
  const Chain narrow(spheres, {}, Exclusion::arc(1)), wide(spheres, {}, Exclusion::arc(3));
  const Frames frames({narrow, wide, narrow});
  const Thinning thinning = thin(frames, {}, 0.2);
  const auto coarse = thinned(std::make_unique<Frames>(frames), thinning);
  for (const auto& [f, factor] : {std::pair(0u, 1.0), {1u, 3.0}, {2u, 1.0}})
    EXPECT_EQ(coarse->frame(f).exclusion().factor, factor) << f;
}

TEST(Thin, RefusesWhatItCannotDo) {
  const std::vector<Sphere> two{{0, 0, 0, 1}, {1, 0, 0, 1}};
  const Chain chain(two, {}, Exclusion::arc(bending_window));
  for (const double wrong : {0.0, -0.1, 1.0, 7.0, std::nan("")})
    EXPECT_THROW(thin(Frames({chain}), {}, wrong), InputError) << wrong;
  EXPECT_THROW(thin(Frames({Chain(two)}), {}, 0.1), InputError);
  EXPECT_THROW(thin(Frames({chain, Chain({two[0]}, {}, Exclusion::arc(bending_window))}), {}, 0.1),
               InputError);
  EXPECT_EQ(thin(Frames({chain}), {}, 0.1).kept.size(), 2u);
  EXPECT_EQ(thin(Frames({Chain({}, {}, Exclusion::arc(bending_window))}), {}, 0.1).kept.size(), 0u);
}

TEST(OpenInput, LeavesOutWhatATolerancePermits) {
  InputOptions options;
  options.arc_window = bending_window;
  options.tolerance = 0.05;
  const Input scene = open_input("path1:n=20000,spacing=0.1,frame=3", options);
  ASSERT_TRUE(scene.thinning.has_value());
  const Chain chain = scene.animation->frame(0);
  EXPECT_EQ(chain.size(), scene.thinning->kept.size());
  EXPECT_EQ(scene.thinning->spheres, 20000u);
  EXPECT_LT(chain.size(), 20000u);
  for (const std::uint32_t i : {0u, 7u, chain.size() - 1})
    EXPECT_EQ(scene.labels.of(i), std::to_string(scene.thinning->kept[i]));
  ASSERT_FALSE(scene.warnings.empty());
  EXPECT_NE(scene.warnings.back().find("of 20000 spheres are kept"), std::string::npos)
      << scene.warnings.back();

  // A step that is too wide in the input is said, too, and none that is not.
  for (const auto& [x, said] : {std::pair("1.5", true), {"0.2", false}}) {
    std::string text = "x,y,z,r\n";
    for (int i = 0; i <= 100; ++i) text += std::to_string(i * 0.01) + ",0,0,1\n";
    const TestFile rod("a.csv", text + std::to_string(1 + std::stod(x)) + ",0,0,1\n");
    const std::string warning = open_input(rod.path().string(), options).warnings.back();
    EXPECT_NE(warning.find("of 102 spheres are kept"), std::string::npos) << warning;
    EXPECT_EQ(warning.find("between spheres that are neighbours in the input") != std::string::npos, said)
        << warning;
  }

  const Input neuron = open_input(example("Neuron.swc").string(), options);
  const Input all =
      open_input(example("Neuron.swc").string(), [&] { return options.tolerance.reset(), options; }());
  ASSERT_FALSE(all.joints.empty());
  ASSERT_EQ(neuron.joints.size(), all.joints.size());
  for (std::size_t k = 0; k < all.joints.size(); ++k)
    for (std::uint32_t Pair::*end : {&Pair::i, &Pair::j})
      EXPECT_EQ(neuron.labels.of(neuron.joints[k].*end), all.labels.of(all.joints[k].*end));
}

/// What one frame needs is held against all: no stretch that is left loses more than the tolerance in any
/// frame, and what is said to be lost is the most of them. Each frame is made twice where another than the
/// first needs more, else once.
TEST(Thinned, LooksAtEachFrameOnceOrTwice) {
  std::mt19937 random(11);
  const Chain first(crooked(random, 400), {}, Exclusion::arc(bending_window));
  for (const bool alike : {true, false}) {
    std::vector<Chain> chains{first};
    for (int f = 0; f < 5; ++f) {
      std::vector<Sphere> spheres =
          alike ? std::vector<Sphere>(first.spheres().begin(), first.spheres().end()) : crooked(random, 400);
      for (Sphere& s : spheres) s.x += static_cast<float>(alike ? f : 0);
      chains.push_back(first.moved(std::move(spheres)));
    }
    const Asked animation(chains);
    constexpr double tolerance = 0.2;
    const Thinning thinning = thin(animation, {}, tolerance);
    std::vector<int> times(6, alike ? 1 : 2);
    times[0] = 1;
    EXPECT_EQ(animation.times, times);
    EXPECT_GT(thinning.kept.size(), 40u);
    EXPECT_LT(thinning.kept.size(), 300u);
    EXPECT_EQ(thin(FirstFrameOnly(animation), {}, tolerance).kept == thinning.kept, alike)
        << "another frame than the first needs more, or none does";
    double lost = 0, own = 0;
    const auto share = [](std::span<const Sphere> stretch) {
      return tube_loss(stretch) / std::ranges::min_element(stretch, {}, &Sphere::radius)->radius;
    };
    for (const Chain& chain : chains) {
      for (std::size_t k = 1; k < thinning.kept.size(); ++k)
        if (const std::uint32_t at = thinning.kept[k - 1], steps = thinning.kept[k] - at; steps > 1)
          lost = std::max(lost, share(chain.spheres().subspan(at, steps + 1)));
      for (std::uint32_t i = 1; i < chain.size(); ++i)
        own = std::max(own, share(chain.spheres().subspan(i - 1, 2)));
    }
    EXPECT_LE(lost, tolerance);
    EXPECT_EQ(thinning.lost, lost);
    EXPECT_EQ(thinning.own, own);
  }
}

}  // namespace
}  // namespace catena
