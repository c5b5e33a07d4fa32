#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/core/plan/coarse_look.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/keeps_answer.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/answer.h"
#include "catena/reference/certificate.h"
#include "catena/reference/evidence_tree.h"
#include "catena/reference/exact_gap.h"
#include "catena/reference/reference.h"

namespace catena {
namespace {

using Want = Request::Want;

constexpr std::uint32_t n = CoarseLook::least + 500;

/// A row that comes back beside itself, so near or not that it touches, and of which `pairs` of spheres
/// touch.
Chain fold(bool touches, std::uint32_t pairs = n) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t along = std::min(i, n - 1 - i);
    spheres.push_back({static_cast<float>(3 * along),
                       i < n / 2                  ? 0.f
                       : touches && along < pairs ? 2.f
                                                  : 3.f,
                       0, 1});
  }
  return Chain(std::move(spheres));
}

/// The step that a look saved tells which spheres collide.
void expect_told(const Variant& variant, const Chain& chain) {
  const Plan plan = variant.plan();
  const auto step = std::ranges::find(plan, info_of(Omission::other_places).step, &Decision::step);
  ASSERT_NE(step, plan.end());
  std::uint32_t i = 0, j = 0;
  ASSERT_EQ(std::sscanf(step->removed.c_str(), "build and search: spheres %u and %u collide", &i, &j), 2)
      << step->removed;
  EXPECT_TRUE(reference::overlap(chain[i], chain[j]));
}

/// Whatever was prepared for, in whatever frame, and whatever is asked then, of whichever spheres: contacts,
/// kept answers and searchers of what came before are none of what is asked now.
TEST(Auto, AnswersWhatIsAskedOfThisFrameWhateverWasAskedOfOthers) {
  std::vector<Chain> frames;
  for (const Chain& frame : {fold(false), fold(true), fold(true, 50), fold(false)}) frames.push_back(frame);
  frames.push_back(open_input("path1:n=1000").animation->frame(0));  // of another length
  frames.push_back(frames[1]);
  std::vector<Sphere> along(frames[1].spheres().begin(), frames[1].spheres().end());
  std::ranges::rotate(along, along.begin() + 3);
  frames.push_back(frames[1].moved(std::move(along)));
  std::vector<reference::Answer> exact;
  for (const Chain& frame : frames) exact.push_back(reference::find(frame));
  std::mt19937 dice(3);
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(dice() % limit); };
  std::vector<SphereRange> differ;
  const auto truth = [&](const Chain& before, const Chain& now) {
    differ.clear();
    if (before.size() != now.size() || below(2) == 0) return Moved();
    if (std::ranges::equal(before.spheres().subspan(3), now.spheres().first(now.size() - 3)))
      return Moved::along(3);
    for (std::uint32_t i = 0; i < now.size(); ++i) {
      if (before[i] == now[i]) continue;
      if (differ.empty() || differ.back().end < i) differ.push_back({i, i});
      differ.back().end = i + 1;
    }
    return Moved(differ);
  };
  for (const char* name : {"auto", "auto(frames=always)", "auto(keep=after-hit+pair-list)"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    std::size_t on_frame = 0;
    variant->build(frames[0]);
    for (int k = 0; k < 400; ++k) {
      constexpr Want wants[] = {Want::any, Want::counts, Want::pairs};
      const SphereRange ranges[] = {{}, {}, {0, n / 3}, {n / 3, n}};
      const auto request = [&] { return Request{.want = wants[below(3)], .queries = ranges[below(4)]}; };
      if (below(2) == 0) {
        Request prepared = request();
        prepared.frames_follow = below(2) == 0;
        variant->prepare(prepared);
      }
      const Chain& before = frames[on_frame];
      on_frame = below(frames.size());
      const Chain& chain = frames[on_frame];
      if (below(3) == 0) {
        variant->build(chain);
        EXPECT_NE(variant->answered_by(), "the frame before") << "built anew";
      } else {
        variant->update(chain, truth(before, chain));
      }
      if (variant->answered_by() == "a look at likely places") expect_told(*variant, chain);
      for (std::size_t asks = below(3); asks > 0; --asks) {
        if (below(3) == 0) variant->prepare(request());  // for the next one
        const Request asked = request();
        Collisions found;
        const bool kept = below(2) == 0;
        if (kept)
          found = dynamic_cast<KeepsAnswer&>(*variant).find_kept(chain, asked);
        else
          variant->find(chain, asked, found);
        std::vector<Pair> pairs;
        std::vector<std::uint32_t> counts(chain.size(), 0);
        for (const Pair& p : exact[on_frame].pairs) {
          if (asked.queries.contains(p.i)) pairs.push_back(p), ++counts[p.i];
          if (asked.queries.contains(p.j)) ++counts[p.j];
        }
        ASSERT_EQ(found.found, !pairs.empty()) << name << ' ' << k;
        if (!kept && asked.want == Want::any) {
          EXPECT_EQ(found.pair_count, 0u);
        }
        if (asked.want == Want::any) continue;
        ASSERT_EQ(found.pair_count, pairs.size()) << name << ' ' << k;
        ASSERT_EQ(found.count, counts) << name << ' ' << k;
        properties::sort(found.pairs);
        if (asked.want == Want::pairs) {
          ASSERT_EQ(found.pairs, pairs) << name << ' ' << k;
        } else if (!kept) {
          ASSERT_TRUE(found.pairs.empty()) << name << ' ' << k;
        }
      }
    }
  }
}

/// A limit is for who asks for pairs, even where pairs are looked for in place of what is asked.
TEST(Auto, HasNoLimitForWhoAsksForNoPairs) {
  const Chain chain = open_input("yarn:n=3000").animation->frame(0);
  for (const char* name : {"auto", "auto(keep=pair-list)", "auto(keep=pair-list+after-hit)"})
    for (const Want want : {Want::any, Want::counts}) {
      const auto variant = StrategyRegistry::instance().make(name);
      variant->prepare({.want = want});
      variant->build(chain);
      Collisions found;
      EXPECT_NO_THROW(variant->find(chain, {.want = want, .pair_limit = 0}, found)) << name;
      EXPECT_TRUE(found.found);
    }
}

/// What a sphere takes is learnt of searches of all spheres: of some it would be too little.
TEST(Auto, LearnsNothingFromSearchesOfSomeSpheres) {
  const Chain chain = open_input("path1:n=30000").animation->frame(0);
  const auto variant = StrategyRegistry::instance().make("auto");
  variant->build(chain);
  const auto thought = variant->plan().front().estimate_ms;
  Collisions found;
  for (int k = 0; k < 4; ++k) {
    variant->build(chain);
    variant->find(chain, {.queries = {0, 10}}, found);
  }
  variant->build(chain);
  EXPECT_EQ(variant->plan().front().estimate_ms, thought);
}

/// A frame of another number of spheres is a chain of its own.
TEST(Auto, BuildsWhatIsUpdatedToAnotherLength) {
  const Chain first = fold(true), other = open_input("yarn:n=2500").animation->frame(0);
  for (const char* name : {"auto", "auto(frames=always)"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    variant->prepare({.frames_follow = true});
    variant->build(first);
    for (const Chain* const frame : {&first, &other, &other, &first}) {
      variant->update(*frame);
      Collisions found;
      variant->find(*frame, {}, found);
      properties::sort(found.pairs);
      EXPECT_EQ(found.pairs, reference::find(*frame).pairs) << name;
    }
  }
}

/// What is searched whole is put into the order of the frame before while that serves, unless it may not be.
TEST(Auto, KeepsAnOrderInSpaceFromFrameToFrame) {
  std::mt19937 dice(4);
  const auto below = [&](float side) { return std::uniform_real_distribution<float>(0, side)(dice); };
  for (const std::uint32_t spheres : {700u, 2000u}) {
    std::vector<Sphere> gas;
    const float side = 2 * std::cbrt(static_cast<float>(spheres));
    while (gas.size() < spheres) gas.push_back({below(side), below(side), below(side), 0.2f + below(1.4f)});
    // No list of near pairs answers, and so few are searched by one thread whatever it takes here.
    const auto keeps = StrategyRegistry::instance().make("auto(keep=far-pairs)"),
               sorts = StrategyRegistry::instance().make("auto(keep=far-pairs+sort)");
    const auto left_out = [](const Variant& variant) {
      const Plan plan = variant.plan();
      const auto step = std::ranges::find(plan, info_of(Omission::sort).step, &Decision::step);
      return step != plan.end() && step->left_out;
    };
    int kept = 0;
    for (int frame = 0; frame < 12; ++frame) {
      // In the middle all lie elsewhere.
      for (Sphere& s : gas) frame == 6 ? void(s.x = side - s.y) : void(s.x += below(0.4f) - 0.2f);
      const Chain chain(gas);
      const reference::Answer exact = reference::find(chain);
      ASSERT_GT(exact.pair_count, 100u);
      for (Variant* const variant : {keeps.get(), sorts.get()}) {
        if (frame == 0) variant->prepare({.frames_follow = true});
        frame == 0 ? variant->build(chain) : variant->update(chain);
        Collisions found;
        variant->find(chain, {}, found);
        properties::sort(found.pairs);
        EXPECT_EQ(found.pairs, exact.pairs) << frame;
      }
      kept += left_out(*keeps);
      EXPECT_FALSE(left_out(*sorts)) << spheres << ' ' << frame;
    }
    keeps->build(Chain(gas));
    EXPECT_FALSE(left_out(*keeps)) << "a build is of no earlier frame, wherever its spheres lie";
    EXPECT_GT(kept, 4) << spheres;
    EXPECT_LT(kept, 12) << spheres;
  }
}

/// It shows what it built, which is this frame; where a frame before answers it has nothing to show.
TEST(Auto, GivesEvidenceOfThisFrameOrNone) {
  const Chain first = open_input("yarn:n=1200").animation->frame(0);
  const auto variant = StrategyRegistry::instance().make("auto(frames=always)");
  variant->prepare({.frames_follow = true});
  variant->build(first);
  Collisions found, shown;
  variant->find(first, {}, found);
  std::size_t shows = 0, hides = 0;
  for (int k = 0; k < 30; ++k) {
    std::vector<Sphere> spheres(first.spheres().begin(), first.spheres().end());
    for (std::size_t i = 0; i < spheres.size(); ++i)
      spheres[i].x += k % 10 == 9 ? static_cast<float>(3 * k) + (i % 2 ? 5.f : 0.f)
                                  : 1e-3f * static_cast<float>(k * (i % 3));
    const Chain frame = first.moved(std::move(spheres));
    k % 10 == 0 ? variant->build(frame) : variant->update(frame);
    variant->find(frame, {}, found);
    if (variant->evidence() == Accounting::none) {
      ++hides;
      class Nobody final : public EvidenceSink {
        void discarded(std::uint32_t, std::uint32_t) override {}
        void tested(std::uint32_t, std::uint32_t) override {}
        void excluded(std::uint32_t, std::uint32_t) override {}
      } nobody;
      EXPECT_THROW(variant->find_with_evidence(frame, {}, shown, nobody), std::logic_error);
      continue;
    }
    ++shows;
    reference::EvidenceTree tree(frame);
    visit_evidence_nodes(*variant, frame, tree);
    tree.complete();
    reference::CertificateChecker checker(frame, tree, variant->evidence(), {});
    variant->find_with_evidence(frame, {}, shown, checker);
    EXPECT_TRUE(checker.report().holds()) << k << ": " << checker.report().fault();
  }
  EXPECT_GT(shows, 0u);
  EXPECT_GT(hides, 0u);
}

}  // namespace
}  // namespace catena
