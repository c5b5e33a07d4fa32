// Sequences of frames of all kinds, of few spheres, so that every run, row and list has ends that matter.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/frames/frame_search.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/sorted_pairs.h"

namespace catena {
namespace {

using properties::Dice;

/// One tube from frame to frame, and what is told of how it moves.
class Film {
 public:
  explicit Film(Dice& dice) : dice_(dice) { begin(); }

  const Chain& chain() const { return chain_; }
  const std::string& what() const { return what_; }
  /// Views the ranges, until the next call.
  Moved next() {
    std::vector<Sphere> spheres(chain_.spheres().begin(), chain_.spheres().end());
    const auto n = static_cast<std::uint32_t>(spheres.size());
    ranges_.clear();
    const bool told = dice_.one_in(2);
    Moved moved;
    switch (n == 0 ? 9 : dice_.below(10)) {
      case 0:
        what_ = "unmoved";
        if (told) moved = Moved(std::span(ranges_));
        break;
      case 1:
      case 2: {
        what_ = "parts";
        for (std::uint32_t at = dice_.below(n); at < n && ranges_.size() < 3; at += 1 + dice_.below(n)) {
          ranges_.push_back({at, std::min(n, at + 1 + dice_.below(12))});
          for (std::uint32_t i = at; i < ranges_.back().end; ++i) spheres[i] = any();
          at = ranges_.back().end;
        }
        if (told) moved = Moved(std::span(ranges_));
        break;
      }
      case 3:
      case 4: {
        what_ = "shifted";
        const int s = (dice_.one_in(2) ? 1 : -1) * static_cast<int>(1 + dice_.below(dice_.one_in(2) ? 9 : n));
        std::vector<Sphere> shifted;
        for (int i = 0; i < static_cast<int>(n); ++i)
          shifted.push_back(i + s >= 0 && i + s < static_cast<int>(n) ? spheres[static_cast<std::size_t>(i + s)]
                                                                     : any());
        spheres = std::move(shifted);
        if (told && can_shift_) moved = Moved::along(s);
        break;
      }
      case 5:
      case 6:
      case 7: {
        what_ = "shaken";
        const float by = size_ * dice_.pick({0.001f, 0.02f, 0.3f});
        for (Sphere& s : spheres) {
          s.x += by * dice_.symmetric(), s.y += by * dice_.symmetric(), s.z += by * dice_.symmetric();
          if (dice_.one_in(4)) s.radius = std::max(0.0f, s.radius + by * dice_.symmetric());
        }
        break;
      }
      case 8:
        what_ = "zeros of another sign";
        for (Sphere& s : spheres)
          if (dice_.one_in(3)) s.z = dice_.one_in(2) ? 0.0f : -0.0f;
        break;
      default:
        what_ = "another tube";
        begin();
        return {};
    }
    chain_ = chain_.moved(std::move(spheres));
    return moved;
  }

 private:
  void begin() {
    const std::uint32_t n = dice_.pick({0u, 1u, 2u, 3u, 7u, 8u, 9u, 15u, 16u, 17u, 33u, 64u, 65u, 130u, 200u});
    size_ = dice_.pick({1.0f, 1.0f, 1e-20f, 1e-38f, 2e37f});
    room_ = dice_.pick({1.5f, 4.0f, 12.0f});
    kind_ = dice_.below(4);
    std::vector<Sphere> spheres(n);
    for (Sphere& s : spheres) s = any();
    Strands strands;
    if (dice_.one_in(3) && n > 2) {
      const std::uint32_t cut = 1 + dice_.below(n - 1);
      strands = {{0, cut, n}, {dice_.one_in(2), dice_.one_in(2)}};
    }
    Exclusion rule = dice_.one_in(4) ? Exclusion::arc(1 + dice_.unit())
                                     : Exclusion::index(dice_.pick({1u, 2u, 9u}));
    if (dice_.one_in(5) && n > 4) rule.extra_pairs = {{0, n - 1}};
    can_shift_ = rule.rule == Exclusion::Rule::index_window && strands.first.empty() && rule.extra_pairs.empty();
    chain_ = Chain(std::move(spheres), std::move(strands), rule);
  }
  Sphere any() {
    const float radius = kind_ == 0   ? 1.0f
                         : kind_ == 1 ? dice_.unit()
                         : kind_ == 2 ? dice_.pick({0.0f, 0.1f, 2.0f})
                                      : 0.01f;
    const auto at = [&] { return size_ * room_ * dice_.symmetric(); };
    return {at(), at(), dice_.one_in(8) ? 0.0f : at(), size_ * radius};
  }

  Dice& dice_;
  Chain chain_;
  std::vector<SphereRange> ranges_;
  std::string what_ = "the first";
  float size_ = 1, room_ = 1;
  std::uint32_t kind_ = 0;
  bool can_shift_ = false;
};

TEST(FrameSearch, IsExactOnFilmsOfAnyKindWhoeverAsks) {
  const auto base = StrategyRegistry::instance().make("Hybrid"), judge = StrategyRegistry::instance().make("CPU1");
  const FullSearch full = [&](const Chain& chain, const Request& request, Collisions& found) {
    base->build(chain);
    base->find(chain, request, found);
  };
  std::array<int, 5> ways{};
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Dice dice(seed);
    Film film(dice);
    FrameSearch search({}, true);
    search.begin(true);
    if (seed % 4 == 0) search.keep_at_most(seed % 97);  // many frames have more pairs, some of them of late
    for (int frame = 0; frame < 24; ++frame) {
      const Chain& chain = film.chain();
      const Request request{.want = dice.pick({Request::Want::pairs, Request::Want::pairs,
                                               Request::Want::counts, Request::Want::any}),
                            .pair_limit = dice.one_in(9) ? 3 : Request().pair_limit};
      for (int times = dice.one_in(5) ? 0 : dice.one_in(5) ? 2 : 1; times > 0; --times) {  // or not searched
        Collisions found, right;
        std::uint64_t true_number = 0;
        judge->build(chain);
        judge->find(chain, {.want = request.want, .pair_limit = ~std::uint64_t{0}}, right);
        try {
          if (dice.one_in(2))
            search.find(chain, request, found, full, full, 0);
          else
            found = search.find_kept(chain, request, full, full, 0);
        } catch (const PairLimitExceeded& error) {
          true_number = error.found();
        }
        const std::string what = "seed " + std::to_string(seed) + " frame " + std::to_string(frame) + ", " +
                                 film.what() + ", way " + std::to_string(static_cast<int>(search.way()));
        if (request.want == Request::Want::pairs && right.pairs.size() > request.pair_limit) {
          ASSERT_EQ(true_number, right.pairs.size()) << what;
          continue;
        }
        ASSERT_EQ(true_number, 0u) << what;
        ASSERT_EQ(found.found, right.found) << what;
        if (request.want == Request::Want::any) continue;
        ASSERT_EQ(found.count, right.count) << what;
        ASSERT_EQ(found.pair_count, right.pair_count) << what;
        if (request.want != Request::Want::pairs) continue;
        properties::sort(found.pairs), properties::sort(right.pairs);
        ASSERT_EQ(found.pairs, right.pairs) << what;
      }
      const Moved moved = film.next();
      ++ways[static_cast<std::size_t>(search.update(film.chain(), moved))];
    }
  }
  for (const int times : ways) EXPECT_GT(times, 200);
}

}  // namespace
}  // namespace catena
