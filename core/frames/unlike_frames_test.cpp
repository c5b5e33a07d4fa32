// Frames that are not the last one moved, and searches between that asked for less: nothing is taken from
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "catena/core/frames/frame_search.h"
#include "catena/core/frames/test_yarn.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"

namespace catena {
namespace {

using test::shaken, test::yarn;
using Way = FrameSearch::Way;

/// What a caller may do with one: answers that are another frame's, or of some spheres alone, are none of the
/// next.
class AnyFrames {
 public:
  AnyFrames() { begin(); }
  void begin() { search_.begin(true); }
  Way update(const Chain& chain, const Moved& moved = {}) { return search_.update(chain, moved); }
  void expect_exact(const Chain& chain, const Request& request, const std::string& what) {
    const FullSearch full = [this](const Chain& c, const Request& r, Collisions& f) {
      base_->build(c);
      base_->find(c, r, f);
    };
    Collisions found, right;
    search_.find(chain, request, found, full, full, 0);
    full(chain, request, right);
    std::ranges::sort(found.pairs);
    std::ranges::sort(right.pairs);
    EXPECT_EQ(found.pairs, right.pairs) << what;
    EXPECT_EQ(found.count, right.count) << what;
    EXPECT_GT(right.pair_count, 0u) << what;
  }

 private:
  FrameSearch search_{{}, true};
  std::unique_ptr<Variant> base_ = StrategyRegistry::instance().make("Hybrid");
};

TEST(FrameSearch, OfAnotherRuleTakesNothingFromTheLastFrame) {
  const Chain first = yarn();
  const std::vector<Sphere> spheres(first.spheres().begin(), first.spheres().end());
  const auto n = first.size();
  Exclusion joined = Exclusion::index(1);
  joined.extra_pairs = {{5, 900}};
  const Chain chains[] = {Chain(spheres),
                          Chain(spheres, {}, Exclusion::index(4)),
                          Chain(spheres, {{0, 1000, n}, {0, 0}}, Exclusion::index(4)),
                          Chain(spheres, {{0, 1500, n}, {0, 0}}, Exclusion::index(4)),
                          Chain(spheres, {{0, 1500, n}, {1, 0}}, Exclusion::index(4)),
                          Chain(spheres, {}, Exclusion::index(4)),
                          Chain(spheres, {}, joined),
                          Chain(spheres, {}, Exclusion::arc(1.5)),
                          Chain(spheres, {}, Exclusion::arc(3))};
  AnyFrames frames;
  frames.expect_exact(chains[0], {}, "first");
  for (std::size_t k = 1; k < std::size(chains); ++k) {
    EXPECT_EQ(frames.update(chains[k]), Way::full) << k;
    frames.expect_exact(chains[k], {}, std::to_string(k));
    EXPECT_EQ(frames.update(chains[k]), Way::unmoved) << k;
    frames.expect_exact(chains[k], {}, std::to_string(k) + " again");
  }
}

/// Under one rule for any number of them.
TEST(FrameSearch, OfOtherSpheresTakesNothingFromTheLastFrame) {
  const Chain whole = yarn();
  const auto first = [&](std::size_t n) {
    const auto spheres = whole.spheres().first(n);
    return Chain({spheres.begin(), spheres.end()});
  };
  AnyFrames frames;
  frames.expect_exact(first(2000), {}, "first");
  for (const std::size_t n : {1999, 2600, 40, 3000, 2999}) {
    EXPECT_EQ(frames.update(first(n)), Way::full) << n;
    if (n > 1000) frames.expect_exact(first(n), {}, std::to_string(n));
  }
}

TEST(FrameSearch, KeepsNoListOfAnotherRule) {
  const Chain first = yarn();
  std::vector<Sphere> spheres(first.spheres().begin(), first.spheres().end());
  AnyFrames frames;
  frames.expect_exact(Chain(spheres, {}, Exclusion::index(40)), {}, "first");
  for (const std::uint32_t window : {40u, 1u, 1u}) {
    spheres = shaken(spheres, 0.01f);
    const Chain chain(spheres, {}, Exclusion::index(window));
    frames.update(chain);
    frames.expect_exact(chain, {}, "window " + std::to_string(window));
  }
}

/// A film that begins anew, with the same spheres under another rule.
TEST(FrameSearch, KeepsNoListOfAnotherFilm) {
  const Chain first = yarn();
  const std::vector<Sphere> here(first.spheres().begin(), first.spheres().end()), there = shaken(here, 0.01f);
  AnyFrames frames;
  for (const std::uint32_t window : {40u, 1u, 40u}) {
    frames.begin();
    for (int frame = 0; frame < 4; ++frame) {
      const Chain chain(frame % 2 == 0 ? here : there, {}, Exclusion::index(window));
      if (frame > 0) {
        EXPECT_EQ(frames.update(chain), Way::kept_list);
      }
      frames.expect_exact(chain, {}, "window " + std::to_string(window));
    }
  }
}

TEST(FrameSearch, HeedsWhatMovedInFramesThatWereNotSearched) {
  Chain chain = yarn();
  AnyFrames frames;
  frames.expect_exact(chain, {}, "first");
  for (const std::uint32_t at : {100u, 900u}) {
    std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
    for (std::uint32_t i = at; i < at + 40; ++i) spheres[i] = spheres[i + 1000];
    chain = chain.moved(spheres);
    const SphereRange told{at, at + 40};
    frames.update(chain, Moved(std::span(&told, 1)));
  }
  frames.expect_exact(chain, {}, "the first one's were not searched");
}

TEST(FrameSearch, OfSomeSpheresAloneIsNoAnswerOfAll) {
  const Chain chain = yarn();
  AnyFrames frames;
  frames.expect_exact(chain, {.queries = {10, 700}}, "some");
  frames.update(chain);
  frames.expect_exact(chain, {}, "all");
  frames.update(chain);
  frames.expect_exact(chain, {.queries = {10, 700}}, "some of an answer of all");
}

/// The reason why all is searched is the one that it is for.
TEST(FrameSearch, SaysWhyItSearchesAll) {
  const Chain first = yarn();
  const std::vector<Sphere> spheres(first.spheres().begin(), first.spheres().end());
  std::vector<Sphere> along = spheres;
  std::ranges::rotate(along, along.begin() + 40);
  const auto expect = [&](const Chain& chain, const Chain& next, const std::string& why,
                          std::uint64_t most = 0) {
    FrameSearch search({}, true);
    if (most > 0) search.keep_at_most(most);
    const auto base = StrategyRegistry::instance().make("Hybrid");
    const FullSearch full = [&](const Chain& c, const Request& r, Collisions& f) {
      base->build(c);
      base->find(c, r, f);
    };
    Collisions found;
    search.begin(true);
    const Request counts{.want = Request::Want::counts};
    search.find(chain, counts, found, full, full, 0);
    search.update(next, {});
    search.find(next, counts, found, full, full, 0);
    ASSERT_EQ(search.way(), Way::full);
    EXPECT_TRUE(search.plan()[0].reason.starts_with(why)) << search.plan()[0].reason;
  };
  const Chain arc(spheres, {}, Exclusion::arc(1.5));
  expect(
      arc, arc.moved(along),
      "too little in common with the frame before; a shift is looked for in one open strand under an index "
      "window; under an arc window no list is kept");
  expect(first, arc, "not the chain of the frame before, or not its rule");
  expect(first, first.moved(along), "more pairs collide than are kept from frame to frame, or so", 5);
}

/// Once many frames have taken half as long as a full search, which here takes as long as it is told to.
TEST(FrameSearch, SaysThatItSearchesAllToKnowWhatThatTakes) {
  std::vector<Sphere> row;
  for (int i = 0; i < 30000; ++i) row.push_back({3 * static_cast<float>(i), 0, 0, 1});
  const Chain chain(row), other(row, {}, Exclusion::index(2));
  double full_ms = 0, frame_ms = 1e9;
  const FullSearch none = [&](const Chain& c, const Request&, Collisions& found) {
    const Stopwatch watch;
    found = {};
    found.count.assign(c.size(), 0);
    while (watch.ms() < full_ms) continue;
  };
  FrameSearch search({}, false);
  Collisions found;
  std::string reason;
  const auto next = [&](const Chain& frame) {
    const Stopwatch watch;
    search.update(frame, {});
    search.find(frame, {}, found, none, none, 0);
    if (search.way() == Way::full) reason = search.plan()[0].reason;
    return watch.ms();
  };
  const auto told = [&] { return reason.starts_with("once in a while"); };
  std::size_t frames = 0;
  for (int tries = 0; tries < 20 && !told(); ++tries) {  // a frame in whose time others ran spoils one
    full_ms = 0;
    for (int k = 0; k < 10; ++k) {
      search.begin(true);
      next(other), next(chain), frame_ms = std::min(frame_ms, next(chain));
    }
    full_ms = 2 * frame_ms;
    search.begin(true);
    for (int k = 0; k < 3; ++k) next(other), next(chain);
    reason.clear();
    for (frames = 0; frames < 1000 && !told(); ++frames) next(chain);
  }
  EXPECT_EQ(reason, "once in a while, to know what it takes") << frames;
  EXPECT_GT(frames, 24u);
}

/// What moved is told of the last build or update, whatever was asked of that, and whether it was a frame of
/// the same spheres or a chain of its own.
TEST(Auto, TakesWhatItIsToldForWhatMovedSinceTheLastFrame) {
  const Chain first = yarn();
  std::vector<Sphere> spheres(first.spheres().begin(), first.spheres().end());
  const Chain last = first.moved(shaken(spheres, 0.3f));
  spheres.assign(last.spheres().begin(), last.spheres().end());
  spheres[5] = spheres[1005];
  const Chain part = last.moved(spheres);
  spheres.assign(last.spheres().begin(), last.spheres().end());
  std::ranges::rotate(spheres, spheres.begin() + 3);
  const Chain along = last.moved(spheres);
  const SphereRange range{5, 6};
  const std::pair<const Chain*, Moved> nexts[] = {{&last, Moved(std::span<const SphereRange>())},
                                                  {&part, Moved(std::span(&range, 1))},
                                                  {&along, Moved::along(3)}};
  const auto pairs_of = [](Variant& variant, const Chain& chain) {
    Collisions found;
    variant.find(chain, {}, found);
    std::ranges::sort(found.pairs);
    return found.pairs;
  };
  const Request all{.frames_follow = true}, any{.want = Request::Want::any, .frames_follow = true},
      some{.queries = {0, 100}, .frames_follow = true};
  const auto right = StrategyRegistry::instance().make("Hybrid");
  for (const char* name : {"auto", "auto(frames=always,keep=far-pairs)"})  // lists would take long
    for (const auto& [next, moved] : nexts) {
      right->build(*next);
      const std::vector<Pair> exact = pairs_of(*right, *next);
      for (const Request& asked : {any, some})
        for (const bool anew : {false, true}) {
          const auto variant = StrategyRegistry::instance().make(name);
          variant->prepare(all), variant->build(first);
          EXPECT_NE(pairs_of(*variant, first), exact);
          variant->prepare(asked);
          anew ? variant->build(last) : variant->update(last);
          Collisions found;
          variant->find(last, asked, found);
          variant->prepare(all), variant->update(*next, moved);
          EXPECT_EQ(pairs_of(*variant, *next), exact) << name << ", " << (anew ? "built" : "updated");
        }
    }
}

}  // namespace
}  // namespace catena
