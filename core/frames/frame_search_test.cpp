#include "catena/core/frames/frame_search.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <random>
#include <stdexcept>
#include <thread>

#include "catena/core/frames/test_yarn.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

using test::shaken, test::yarn;
using Way = FrameSearch::Way;

/// Frames of a chain, each searched; every full search of it is counted.
class Frames {
 public:
  explicit Frames(const Chain& first, std::vector<std::string> keep = {}, bool always = true)
      : search_(Omissions::without(keep), always),
        base_(StrategyRegistry::instance().make("Hybrid")),
        chain_(first) {
    search_.begin(true);
    find();
  }
  /// The way in which the next frame is searched, whose answer is that of a full search.
  Way next(const std::vector<Sphere>& spheres, const Moved& moved = {}) {
    chain_ = chain_.moved(spheres);
    const Way way = search_.update(chain_, moved);
    find();
    Collisions full;
    search_all(chain_, {}, full);
    std::ranges::sort(full.pairs);
    std::ranges::sort(found_.pairs);
    EXPECT_EQ(found_.pairs, full.pairs);
    EXPECT_EQ(found_.count, full.count);
    EXPECT_GT(full.pairs.size(), 0u);
    return way;
  }
  std::vector<Sphere> spheres() const { return {chain_.spheres().begin(), chain_.spheres().end()}; }
  Plan plan() const { return search_.plan(); }
  unsigned searches() const { return searches_; }

 private:
  void search_all(const Chain& chain, const Request& request, Collisions& found) {
    base_->build(chain);
    base_->find(chain, request, found);
  }
  void find() {
    const FullSearch counted = [this](const Chain& c, const Request& r, Collisions& f) {
      ++searches_;
      search_all(c, r, f);
    };
    search_.find(chain_, {}, found_, counted, counted, 0);
  }

  FrameSearch search_;
  std::unique_ptr<Variant> base_;
  Chain chain_;
  Collisions found_;
  unsigned searches_ = 0;
};

TEST(FrameSearch, GoesTheWayThatAFrameAllows) {
  Frames frames(yarn());
  EXPECT_EQ(frames.next(frames.spheres()), Way::unmoved);
  EXPECT_EQ(frames.next(frames.spheres(), Moved(std::span<const SphereRange>())), Way::unmoved);
  auto spheres = frames.spheres();
  for (std::size_t i = 700; i < 760; ++i) spheres[i] = spheres[i + 1000];
  EXPECT_EQ(frames.next(spheres), Way::parts);
  const SphereRange told{100, 130};
  for (std::size_t i = told.begin; i < told.end; ++i) spheres[i].x += 0.5f;
  EXPECT_EQ(frames.next(spheres, Moved(std::span(&told, 1))), Way::parts);
  for (const int by : {40, -13, 2000, 2000}) {  // the last ones out of the row
    spheres = frames.spheres();
    std::ranges::rotate(spheres, by > 0 ? spheres.begin() + by : spheres.end() + by);
    EXPECT_EQ(frames.next(spheres), Way::shifted) << by;
  }
  for (const int by : {40, -13}) {  // told, though it can be seen as well
    spheres = frames.spheres();
    std::ranges::rotate(spheres, by > 0 ? spheres.begin() + by : spheres.end() + by);
    EXPECT_EQ(frames.next(spheres, Moved::along(by)), Way::shifted) << by;
  }
  EXPECT_EQ(frames.searches(), 1u) << "of the first frame alone";
  EXPECT_EQ(frames.next(shaken(frames.spheres(), 0.01f)), Way::kept_list);
  EXPECT_EQ(frames.searches(), 2u) << "of thick spheres";
  EXPECT_EQ(frames.next(shaken(frames.spheres(), 0.01f)), Way::kept_list);
  EXPECT_EQ(frames.searches(), 2u);
  ASSERT_EQ(frames.plan().size(), 1u);
  EXPECT_TRUE(frames.plan()[0].left_out);
  EXPECT_NE(frames.plan()[0].reason.find("3000"), std::string::npos);
}

TEST(FrameSearch, FollowsSpheresThatGoToAndFroAndOtherFramesBetween) {
  Frames frames(yarn());
  std::mt19937 random(9);
  std::uniform_real_distribution<float> by(-0.02f, 0.02f);
  for (int k = 0; k < 60; ++k) {
    std::vector<Sphere> spheres = frames.spheres();
    if (k % 15 == 14) {  // the answer is another's meanwhile
      for (std::size_t i = 100; i < 120; ++i) spheres[i].x += 0.3f;
      EXPECT_EQ(frames.next(spheres), Way::parts) << k;
      continue;
    }
    for (Sphere& s : spheres)
      s.x += by(random), s.y += by(random), s.z += by(random), s.radius += by(random) / 8;
    EXPECT_EQ(frames.next(spheres), Way::kept_list) << k;
  }
  EXPECT_LT(frames.searches(), 40u) << "lists are used";
}

/// Sequences that nothing was measured on: stretches of frames of one kind, one after the other by chance.
TEST(FrameSearch, MeasuredTimesChooseTheWayAndNeverTheAnswer) {
  Frames frames(yarn(), {}, false);
  std::mt19937 random(4);
  const auto by = [&](float most) { return std::uniform_real_distribution<float>(-most, most)(random); };
  const auto shake = [&](std::span<Sphere> some, float most) {
    for (Sphere& s : some) s.x += by(most), s.y += by(most), s.z += by(most);
  };
  std::array<int, 5> ways{};
  for (int stretch = 0; stretch < 40; ++stretch) {
    const unsigned kind = random() % 8;
    const float step = std::array{0.001f, 0.01f, 0.05f, 0.4f}[random() % 4];
    const std::size_t begin = random() % 2500, size = 1 + random() % 500;
    for (int k = 0; k < 12; ++k) {
      std::vector<Sphere> spheres = frames.spheres();
      if (kind < 3) shake(spheres, step);
      if (kind == 3) shake(std::span(spheres).subspan(begin, size), step);
      if (kind == 4 && k % 2 == 0) shake(spheres, step);  // and every other frame does not move
      if (kind == 5)
        for (Sphere& s : spheres) s.radius *= 1 + (k % 2 == 0 ? step : -step) / 4;
      if (kind == 6)  // all turns about an axis
        for (Sphere& s : spheres) s = {s.x - step * s.y, s.y + step * s.x, s.z, s.radius};
      if (kind == 7) std::ranges::rotate(spheres, spheres.begin() + 7);
      ++ways[static_cast<std::size_t>(frames.next(spheres))];
    }
  }
  EXPECT_GT(ways[static_cast<std::size_t>(Way::full)], 0);
  EXPECT_GT(ways[static_cast<std::size_t>(Way::unmoved)], 0);
}

TEST(FrameSearch, SearchesAllWhereNothingMayBeLeftOut) {
  const Chain one = yarn(),
              two({one.spheres().begin(), one.spheres().end()}, {{0, 1000, one.size()}, {0, 0}});
  for (const Chain& chain : {one, two}) {
    Frames frames(chain, omission_names());
    EXPECT_EQ(frames.next(frames.spheres()), Way::full);
    EXPECT_EQ(frames.next(shaken(frames.spheres(), 0.01f)), Way::full);
    EXPECT_EQ(frames.searches(), 3u);
    EXPECT_FALSE(frames.plan()[0].left_out);
    EXPECT_TRUE(frames.plan()[0].reason.ends_with(
        "frame before; --no-omit unmoved; --no-omit still-parts; --no-omit shifted; --no-omit far-pairs"))
        << frames.plan()[0].reason;
  }
}

/// Each way that may not be gone is not, told or seen, and the others are.
TEST(FrameSearch, GoesNoWayThatMayNotBeGone) {
  const std::pair<Omission, Way> ways[] = {{Omission::unmoved, Way::unmoved},
                                           {Omission::still_parts, Way::parts},
                                           {Omission::shifted, Way::shifted},
                                           {Omission::far_pairs, Way::kept_list}};
  for (const auto& [kept, closed] : ways) {
    Frames frames(yarn(), {info_of(kept).name});
    const auto expect = [&](Way open, const std::vector<Sphere>& spheres, const Moved& moved = {}) {
      const Way way = frames.next(spheres, moved);
      EXPECT_EQ(way == open, open != closed) << info_of(kept).name;
    };
    expect(Way::unmoved, frames.spheres());
    const SphereRange told{700, 760};
    for (const Moved& moved : {Moved(), Moved(std::span(&told, 1))}) {
      auto spheres = frames.spheres();
      for (std::size_t i = told.begin; i < told.end; ++i) spheres[i].x += 0.5f;
      expect(Way::parts, spheres, moved);
    }
    for (const Moved& moved : {Moved(), Moved::along(40)}) {
      auto spheres = frames.spheres();
      std::ranges::rotate(spheres, spheres.begin() + 40);
      expect(Way::shifted, spheres, moved);
    }
    expect(Way::kept_list, shaken(frames.spheres(), 0.01f));
  }
}

TEST(FrameSearch, ASearchThatFailsLeavesNothingHalfKnown) {
  FrameSearch search({}, true);
  const auto base = StrategyRegistry::instance().make("Hybrid");
  bool fails = false;
  const FullSearch full = [&](const Chain& c, const Request& r, Collisions& f) {
    if (fails) throw std::runtime_error("no memory");
    base->build(c);
    base->find(c, r, f);
  };
  const Chain first = yarn();
  Collisions found, exact;
  search.begin(true);
  search.find(first, {}, found, full, full, 0);
  const Chain next = first.moved(shaken({first.spheres().begin(), first.spheres().end()}, 0.05f));
  EXPECT_EQ(search.update(next, {}), Way::kept_list);
  fails = true;
  EXPECT_THROW(search.find(next, {}, found, full, full, 0), std::runtime_error);
  fails = false;
  search.find(next, {}, found, full, full, 0);
  full(next, {}, exact);
  EXPECT_EQ(found.count, exact.count);
  EXPECT_GT(exact.pair_count, 0u);
}

/// What a plan says of a frame is of that frame, whatever way the one before went.
TEST(FrameSearch, SaysOfAFrameWhatWasDoneForIt) {
  Frames frames(yarn());
  auto spheres = frames.spheres();
  for (std::size_t i = 700; i < 760; ++i) spheres[i] = spheres[i + 1000];
  EXPECT_EQ(frames.next(spheres), Way::parts);
  EXPECT_EQ(frames.plan()[0].reason, "80 of 3000 spheres moved") << "in steps of sixteen";
  EXPECT_EQ(frames.plan()[0].removed, "all but 10 runs of 8");
  const SphereRange told{700, 760};
  EXPECT_EQ(frames.next(spheres, Moved(std::span(&told, 1))), Way::parts);
  EXPECT_EQ(frames.plan()[0].reason, "60 of 3000 spheres moved") << "as it was told";
  const SphereRange beyond{2990, 5000};
  EXPECT_EQ(frames.next(spheres, Moved(std::span(&beyond, 1))), Way::parts);
  EXPECT_EQ(frames.plan()[0].reason, "10 of 3000 spheres moved") << "of those that there are";
  spheres = frames.spheres();
  std::ranges::rotate(spheres, spheres.begin() + 40);
  EXPECT_EQ(frames.next(spheres), Way::shifted);
  EXPECT_EQ(frames.plan()[0].reason, "sphere i is what i + 40 was, of 3000");
  EXPECT_EQ(frames.next(frames.spheres()), Way::unmoved);
  EXPECT_EQ(frames.plan()[0].reason, "none of 3000 spheres differs");
  EXPECT_EQ(frames.next(shaken(frames.spheres(), 0.01f)), Way::kept_list);
  const std::string open = frames.plan()[0].removed;
  EXPECT_NE(open.find(" pairs whose state may change"), std::string::npos) << open;
  EXPECT_GT(std::stoul(open.substr(open.find_first_of("0123456789"))), 100u) << open;
}

/// The estimate is of the full search that was left out, the other time is that of what was done.
TEST(FrameSearch, TellsItsTimesAndItsListAsTheyAre) {
  constexpr double slept_ms = 200;  // far more than a list takes, on a busy machine too
  const auto base = StrategyRegistry::instance().make("Hybrid");
  auto kept = std::make_unique<KeptList>();
  const KeptList& list = *kept;
  FrameSearch frames({}, true, std::move(kept));
  const FullSearch slow = [&](const Chain& c, const Request& r, Collisions& f) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(slept_ms));
    base->build(c);
    base->find(c, r, f);
  };
  Chain chain = yarn();
  Collisions found;
  const auto next = [&](const std::vector<Sphere>& spheres) {
    chain = chain.moved(spheres);
    frames.update(chain, {});
    frames.find(chain, {}, found, slow, slow, 0);
    return frames.plan().at(0);
  };
  frames.begin(true);
  frames.find(chain, {}, found, slow, slow, 0);
  EXPECT_TRUE(frames.plan().empty()) << "there was nothing to decide about a first frame";
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  const Decision still = next(spheres);
  ASSERT_EQ(frames.way(), Way::unmoved);
  EXPECT_GE(still.estimate_ms.value(), slept_ms);
  EXPECT_LT(still.actual_ms.value(), slept_ms);
  EXPECT_EQ(still.removed, fmt::format("{:.3g} ms of a full search", *still.estimate_ms));
  for (int k = 1; k <= 2; ++k) {  // makes the list, then uses it
    const Decision by_list = next(spheres = shaken(spheres, 0.001f));
    ASSERT_EQ(frames.way(), Way::kept_list);
    EXPECT_EQ(by_list.reason, fmt::format("each of 3000 spheres is within a skin of {:.3g}", list.skin()));
    EXPECT_EQ(by_list.removed, fmt::format("all but {} pairs whose state may change", list.open_size()));
    EXPECT_EQ(by_list.actual_ms.value() >= slept_ms, k == 1);
  }
}

}  // namespace
}  // namespace catena
