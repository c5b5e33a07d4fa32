#include "catena/core/plan/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/sorted_pairs.h"

namespace catena {
namespace {

using Want = Request::Want;

void expect_right(const Chain& chain, const Collisions& found, Want want) {
  Collisions full;
  const auto variant = StrategyRegistry::instance().make("Hybrid");
  variant->build(chain);
  variant->find(chain, {}, full);
  EXPECT_EQ(found.found, full.found);
  if (want == Want::any) return;
  EXPECT_EQ(found.count, full.count);
  EXPECT_EQ(found.pair_count, full.pair_count);
  if (want == Want::counts) return;
  std::vector<Pair> pairs = found.pairs;
  properties::sort(pairs), properties::sort(full.pairs);
  EXPECT_EQ(pairs, full.pairs);
}

/// Of frames that move as a whole, in parts, along themselves and not at all, told and not.
TEST(Film, AnswersEachFrame) {
  for (const Want want : {Want::pairs, Want::counts, Want::any})
    for (const char* scene : {"yarn:n=5000", "path1:n=5000"}) {
      Chain chain = open_input(scene).animation->frame(0);
      Film film(want);
      expect_right(chain, film.next(chain), want);
      const auto frame = [&](auto change, const Moved& moved = {}) {
        std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
        change(spheres);
        chain = chain.moved(std::move(spheres));
        expect_right(chain, film.next(chain, moved), want);
      };
      for (int k = 0; k < 4; ++k) {
        frame([](auto&) {});
        frame([](auto&) {}, Moved(std::span<const SphereRange>()));
        const SphereRange told{1000, 1200};
        const auto part = [&](auto& spheres) {
          for (std::uint32_t i = told.begin; i < told.end; ++i)
            spheres[i].x += 0.3f * static_cast<float>(i % 5);
        };
        frame(part), frame(part, Moved(std::span(&told, 1)));
        const auto along = [](auto& spheres) { std::ranges::rotate(spheres, spheres.begin() + 40); };
        frame(along), frame(along, Moved::along(40));
        frame([](auto& spheres) {
          for (std::size_t i = 0; i < spheres.size(); ++i) spheres[i].y += i % 2 ? 0.01f : -0.01f;
        });
      }
    }
}

TEST(Film, GoesOnWhereItIsMovedTo) {
  const Chain chain = open_input("yarn:n=5000").animation->frame(0);
  std::vector<Film> films;
  films.emplace_back();
  const Collisions* const answer = &films.front().next(chain);
  films.emplace_back();  // makes room for itself
  EXPECT_EQ(&films.front().next(chain), answer) << "the same frame again";
  expect_right(chain, *answer, Want::pairs);
  films.back() = std::move(films.front());
  EXPECT_EQ(&films.back().next(chain), answer);
}

/// The answer is not copied: the same memory holds it in every frame.
TEST(Film, LeavesAnUnmovedFramesAnswerWhereItIs) {
  const Chain chain = open_input("yarn:n=5000").animation->frame(0);
  Film film;
  film.next(chain);
  const Collisions& first = film.next(chain, Moved(std::span<const SphereRange>()));
  const Pair* const pairs = first.pairs.data();
  const Collisions& second = film.next(chain, Moved(std::span<const SphereRange>()));
  EXPECT_EQ(&first, &second);
  EXPECT_EQ(second.pairs.data(), pairs);
  EXPECT_EQ(film.variant().answered_by(), "the frame before");
}

/// Who says what moved is believed, without a look.
TEST(Film, ComparesNothingOfWhatItIsTold) {
  const Chain chain = open_input("yarn:n=5000").animation->frame(0);
  std::vector<Sphere> apart(chain.spheres().begin(), chain.spheres().end());
  for (std::size_t i = 0; i < apart.size(); ++i) apart[i].x += static_cast<float>(100 * i);
  Film film;
  const std::uint64_t pairs = film.next(chain).pair_count;
  ASSERT_GT(pairs, 0u);
  EXPECT_EQ(film.next(chain.moved(apart), Moved(std::span<const SphereRange>())).pair_count, pairs);
}

}  // namespace
}  // namespace catena
