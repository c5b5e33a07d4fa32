#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/failing_allocations.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/testing/letters_of.h"
#include "catena/properties/testing/random_spheres.h"
#include "catena/reference/reference.h"

// Who ran out of memory and has it again answers as one that never did.
namespace catena::properties {
namespace {

struct ForgottenEvidence final : EvidenceSink {
  void discarded(std::uint32_t, std::uint32_t) override {}
  void tested(std::uint32_t, std::uint32_t) override {}
  void excluded(std::uint32_t, std::uint32_t) override {}
};

struct Unseen final : BoundsVisitor {
  void tree(const TreeFacts&) override {}
  void edge(std::uint32_t, const AnyBound&, std::uint32_t, const AnyBound&) override {}
};

/// All that can be asked of a variant, whatever became of its last build.
void look_at(Variant& variant) {
  static_cast<void>(variant.plan());
  static_cast<void>(variant.work());
  static_cast<void>(variant.timings());
  static_cast<void>(variant.answered_by());
  static_cast<void>(variant.evidence());
  Unseen unseen;
  variant.visit_bounds(unseen);
}

/// A chain and its right answer.
struct Solved {
  Chain chain;
  reference::Answer right;
  explicit Solved(Chain of) : chain(std::move(of)), right(reference::find(chain)) {}

  /// What comes after a build that threw: nothing is built, unless nothing needs to be.
  void expect_of_or_refusal(Variant& variant) const {
    look_at(variant);
    try {
      expect_of(variant);
    } catch (const std::logic_error&) {
    }
  }
  void expect_of(Variant& variant) const {
    Collisions found;
    variant.find(chain, {}, found);
    sort(found.pairs);
    EXPECT_EQ(found.pairs, right.pairs);
    EXPECT_EQ(found.count, right.count);
    if (variant.evidence() == Accounting::none) return;
    ForgottenEvidence ignored;
    Collisions with_evidence;
    variant.find_with_evidence(chain, {}, with_evidence, ignored);
    sort(with_evidence.pairs);
    EXPECT_EQ(with_evidence.pairs, right.pairs) << "with evidence";
  }
};

/// Spheres that move on, each by a little of its radius, and grow, so that a list of those near one another
/// is made, kept and made anew.
std::vector<Solved> film() {
  std::mt19937 dice(7);
  std::uniform_real_distribution<float> step(-0.05f, 0.05f);
  std::vector<Sphere> spheres = spheres_in_volume(60, 0.4f, dice);
  std::vector<Solved> frames;
  const Chain first(spheres);
  for (int k = 0; k < 6; ++k) {
    frames.emplace_back(first.moved(spheres));
    for (Sphere& s : spheres)
      s.x += step(dice) * s.radius, s.y += step(dice) * s.radius, s.radius *= 1 + step(dice);
  }
  return frames;
}

/// Does it with no memory but for 0, 1, 2 ... allocations, until that is enough, and `after` each time.
template <class Work, class After>
void expect_nothing_left(const Work& work, const After& after) {
  for (std::int64_t given = 0;; given += 1 + given / 4) {
    bool done = true;
    try {
      const FailingAllocations none(given);
      work();
    } catch (const std::bad_alloc&) {
      done = false;
    }
    SCOPED_TRACE(std::to_string(given) + " allocations");
    after();
    if (done || testing::Test::HasFailure()) return;
  }
}

const std::vector<Solved>& solved() {
  static const std::vector<Solved> all = [] {
    std::mt19937 dice(5);
    std::vector<Solved> made;
    made.emplace_back(Chain(spheres_in_volume(500, 0.4f, dice)));  // crowded
    std::vector<Sphere> row;
    for (int k = 0; k < 200; ++k) row.push_back({static_cast<float>(k), 0, 0, 1.1f});
    made.emplace_back(Chain(row));
    Strands each{{0}, {}};
    std::vector<Sphere> square;
    for (std::uint32_t k = 0; k < 60; ++k) {
      square.push_back({static_cast<float>(k % 8), static_cast<float>(k / 8), 0, 0.5f});
      each.first.push_back(k + 1);
    }
    made.emplace_back(Chain(square, each));
    return made;
  }();
  return all;
}

class OutOfMemory : public testing::TestWithParam<const char*> {};

TEST_P(OutOfMemory, InABuildLeavesNothingBehind) {
  for (const Solved& first : solved())
    for (const Solved& next : solved()) {
      std::unique_ptr<Variant> variant;
      const auto anew = [&] { variant = StrategyRegistry::instance().make(GetParam()); };
      anew();
      expect_nothing_left([&] { variant->build(first.chain); },
                          [&] {
                            first.expect_of_or_refusal(*variant);
                            variant->build(next.chain);
                            next.expect_of(*variant);
                            anew();
                          });
      variant->build(first.chain);
      expect_nothing_left([&] { variant->build(next.chain); },
                          [&] {
                            next.expect_of_or_refusal(*variant);
                            anew();
                            variant->build(first.chain);
                          });
    }
}

TEST_P(OutOfMemory, InASearchLeavesNothingBehind) {
  for (const Solved& first : solved())
    for (const Solved& next : solved()) {
      const auto variant = StrategyRegistry::instance().make(GetParam());
      ASSERT_GT(first.right.pair_count, 0u);
      expect_nothing_left(
          [&] {
            variant->build(first.chain);
            Collisions found;
            variant->find(first.chain, {}, found);
          },
          [&] {
            variant->build(next.chain);
            next.expect_of(*variant);
          });
      variant->build(first.chain);
      expect_nothing_left(
          [&] {
            Collisions found;
            variant->find(first.chain, {}, found);
          },
          [&] { first.expect_of(*variant); });
    }
}

TEST_P(OutOfMemory, InAFrameLeavesNothingBehind) {
  const std::vector<Solved> frames = film();
  for (std::int64_t given = 0; given < 400; given += 1 + given / 8) {
    SCOPED_TRACE(std::to_string(given) + " allocations a frame");
    const auto variant = StrategyRegistry::instance().make(GetParam());
    variant->prepare({.frames_follow = true});
    variant->build(frames[0].chain);
    frames[0].expect_of(*variant);
    for (std::size_t k = 1; k < frames.size(); ++k) {
      bool built = false;
      try {
        const FailingAllocations none(given);
        variant->update(frames[k].chain);
        built = true;
        Collisions found;
        variant->find(frames[k].chain, {}, found);
      } catch (const std::bad_alloc&) {
      }
      built ? frames[k].expect_of(*variant) : frames[k].expect_of_or_refusal(*variant);
    }
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Host, OutOfMemory,
                         testing::Values("auto", "auto(frames=always)", "Hybrid", "Hybrid(threads=2)",
                                         "Hybrid(threads=2,crowd=0,dense=1000000)", "SphereTree", "ChainTree",
                                         "Grid", "LBVH+Half", "SweepAndPrune", "Necklace", "aCPU2+Dual",
                                         "DeviceHybrid@host(least=0)"),
                         [](const auto& variant) { return letters_of(variant.param); });

}  // namespace
}  // namespace catena::properties
