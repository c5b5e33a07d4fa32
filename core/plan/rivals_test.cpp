#include "catena/core/plan/rivals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/sorted_pairs.h"

namespace catena {
namespace {

using Contender = Rivals::Contender;

const Contender first_choice{"planned", 2};
const std::vector<Contender> other_choices{{"planned", 1}, {"a", 1}, {"b", 1}};

/// A film in which each contender takes so long.
struct TimedFilm {
  std::map<std::string, double> ms;
  Rivals rivals;
  double all = 0;
  std::map<std::string, int> searches;

  static std::string key(const Contender& who) { return who.variant + std::to_string(who.threads); }
  void begin(double worth = 0) {
    rivals.begin(first_choice, ++films);
    rivals.join(other_choices, worth);
  }
  std::uint32_t films = 0;
  /// Who was to search when it was looked last, whose plan, of which film; and its turn.
  std::string seen = "";
  std::uint64_t turn = 0;
  std::string search(double times = 1) {
    const std::string who = key(rivals.next());
    const std::string now = who + ' ' + key(rivals.planned()) + ' ' + std::to_string(*rivals.spheres());
    if (now != seen && !seen.empty()) {
      EXPECT_NE(rivals.turn(), turn) << seen << ", then " << now;
    }
    seen = now, turn = rivals.turn();
    const double took = times * ms.at(who);
    rivals.took(took), all += took, ++searches[who];
    return who;
  }
  double least() const {
    return std::ranges::min_element(ms, {}, [](const auto& of) { return of.second; })->second;
  }
  double of(const Contender& who) const { return ms.at(key(who)); }
};

/// Whatever each takes: about the quickest leads soon, and what is lost by trials is some searches and a
/// small share.
TEST(Rivals, TheQuickestLeadsAndTrialsTakeLittle) {
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> random(1, 8);
  for (int film = 0; film < 200; ++film) {
    TimedFilm f;
    for (const char* who : {"planned2", "planned1", "a1", "b1"}) f.ms[who] = random(dice);
    f.begin();
    int k = 0;
    for (; k < 1000 && f.of(f.rivals.leader()) * 0.9 > f.least(); ++k) f.search();
    EXPECT_LT(k, 1000) << film;
    const double led = f.of(f.rivals.leader());
    f.all = 0;
    constexpr int searches = 4000;
    for (k = 0; k < searches; ++k) f.search();
    EXPECT_LE(f.all, 1.03 * searches * led + 16 * 8) << film;
    EXPECT_EQ(f.rivals.replaced(), f.rivals.leader() != first_choice);
    // Who is far behind has not been forgotten: chains change.
    for (const auto& [who, count] : f.searches) EXPECT_GT(count, 1) << who;
  }
}

/// A trial is three searches in a row, and no more than two, or one, of who is behind.
TEST(Rivals, ATrialEndsAsSoonAsItIsLost) {
  TimedFilm f{{{"planned2", 1}, {"planned1", 1.2}, {"a1", 2}, {"b1", 3}}, {}, 0, {}};
  f.begin();
  std::map<std::string, int> longest;
  std::string last;
  int row = 0;
  for (int k = 0; k < 3000; ++k) {
    const std::string who = f.search();
    row = who == last ? row + 1 : 1;
    longest[last = who] = std::max(longest[who], row);
    if (k < static_cast<int>(Rivals::patience)) {
      EXPECT_EQ(who, "planned2");
    }
  }
  EXPECT_EQ(longest["planned1"], static_cast<int>(Rivals::trial));
  EXPECT_EQ(longest["a1"], 2);
  EXPECT_EQ(longest["b1"], 1);
  EXPECT_FALSE(f.rivals.replaced());
}

/// The first search of a trial builds, or finds what was built: it counts where it is the only one.
TEST(Rivals, TheFirstSearchOfATrialDoesNotDecideIt) {
  Rivals rivals;
  rivals.begin(first_choice, 1);
  rivals.join({{"a", 1}}, 0);
  for (int k = 0; k < 200; ++k) {
    const bool tried = rivals.next() != first_choice;
    for (unsigned step = 0; tried && step < Rivals::trial && rivals.next() != first_choice; ++step)
      rivals.took(step == 0 ? 0.01 : 1.2);
    if (!tried) rivals.took(1);
    EXPECT_EQ(rivals.leader(), first_choice) << k;
  }
}

/// What takes very long in a trial says that something else ran: it is booked as eight searches in all,
/// however many the trial had, and others are tried as soon again.
TEST(Rivals, ADisturbedTrialIsBookedOnce) {
  const auto pause = [](std::initializer_list<double> trial) {
    Rivals rivals;
    rivals.begin(first_choice, 1);
    rivals.join({{"a", 1}}, 0);
    while (rivals.next() == first_choice) rivals.took(1);
    for (const double ms : trial) rivals.took(ms);
    EXPECT_EQ(rivals.next(), first_choice);
    int searches = 0;
    for (; rivals.next() == first_choice && searches < 5000; ++searches) rivals.took(1);
    return searches;
  };
  const int once = pause({1000}), twice = pause({1, 1000});
  EXPECT_GT(once, 100);
  EXPECT_NEAR(twice, once, 5);
}

/// What ran meanwhile does not decide who leads for long, whichever searches it disturbs.
TEST(Rivals, ADisturbedSearchIsForgotten) {
  std::mt19937 dice(2);
  for (int film = 0; film < 50; ++film) {
    TimedFilm f{{{"planned2", 2}, {"planned1", 3}, {"a1", 1}, {"b1", 4}}, {}, 0, {}};
    f.begin();
    for (int k = 0; k < 3000; ++k) f.search(dice() % 20 == 0 ? 50 : 1);
    int led = 0;
    for (int k = 0; k < 1000; ++k)
      f.search(dice() % 20 == 0 ? 50 : 1), led += f.rivals.leader().variant == "a";
    EXPECT_GT(led, 800) << film;
  }
}

/// Another leads when chains have changed, and says against whom, and with what times.
TEST(Rivals, FollowWhatChangesAndSayWhatWasMeasured) {
  TimedFilm f{{{"planned2", 2}, {"planned1", 3}, {"a1", 1}, {"b1", 4}}, {}, 0, {}};
  f.begin();
  EXPECT_FALSE(f.rivals.take_lost());
  while (f.rivals.leader().variant != "a") f.search();
  EXPECT_EQ(f.rivals.told_ms(), "took 1 ms where 2 were taken");
  EXPECT_EQ(f.rivals.take_lost(), first_choice);
  EXPECT_FALSE(f.rivals.take_lost()) << "told once";
  f.ms["a1"] = 10;
  for (int k = 0; k < 3000; ++k) f.search();
  EXPECT_EQ(f.rivals.leader(), first_choice);
  EXPECT_FALSE(f.rivals.replaced());
}

/// Who cannot search is not asked again; where it led the planned one does.
TEST(Rivals, GoOnWithoutWhoHasNoRoom) {
  for (const bool led : {false, true}) {
    TimedFilm f{{{"planned2", 2}, {"planned1", 3}, {"a1", 1}, {"b1", 4}}, {}, 0, {}};
    f.begin();
    while (led ? f.rivals.leader().variant != "a" : f.rivals.next().variant != "a") f.search();
    f.rivals.without({"a", 1});
    EXPECT_EQ(f.rivals.next(), first_choice);
    EXPECT_FALSE(f.rivals.replaced());
    if (led) {
      EXPECT_EQ(f.rivals.told_ms(), "took 0 ms where 0 were taken")
          << "the planned one was not compared as the leader";
    }
    f.searches.clear();
    for (int k = 0; k < 2000; ++k) f.search();
    EXPECT_EQ(f.searches.count("a1"), 0u);
    EXPECT_GT(f.searches["b1"], 0);
    EXPECT_EQ(f.rivals.leader(), first_choice);
  }
}

/// None where the leader takes too little to be beaten.
TEST(Rivals, AreNotTriedWhereThatIsNotWorthIt) {
  TimedFilm f{{{"planned2", 2}, {"planned1", 1}, {"a1", 1}, {"b1", 1}}, {}, 0, {}};
  f.begin(2);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(f.search(), "planned2");
  f.begin(1.99);
  for (int k = 0; k < 100; ++k) f.search();
  EXPECT_NE(f.rivals.leader(), first_choice);
}

/// Who leads one frame leads the next, for which another is planned: that one is tried before long. Not where
/// nobody was compared; and another chain is searched as it was planned.
TEST(Rivals, GoOnWithTheNextFrameAndBeginWithAnotherChain) {
  TimedFilm f{{{"planned2", 2}, {"planned1", 3}, {"a1", 1}, {"b1", 4}, {"new1", 0.5}}, {}, 0, {}};
  f.begin();
  f.rivals.go_on({"b", 1});
  EXPECT_EQ(f.rivals.leader().variant, "b") << "nobody was compared";
  f.begin();
  for (unsigned k = 1; k < Rivals::patience; ++k) f.search();
  f.rivals.go_on({"b", 1});
  for (int k = 0; k < 3; ++k) EXPECT_EQ(f.search(), "b1") << "its own times are needed first";
  f.begin();
  while (f.rivals.next() == first_choice) f.search();
  f.rivals.go_on(f.rivals.next());
  for (unsigned k = 0; k < Rivals::trial; ++k) f.search();
  EXPECT_FALSE(f.rivals.take_lost()) << "who was tried leads, and is tried against nobody";
  f.begin();
  while (f.rivals.leader().variant != "a") f.search();
  f.rivals.go_on(first_choice);
  EXPECT_EQ(f.rivals.leader().variant, "a") << "the same";
  f.rivals.go_on({"new", 1});
  EXPECT_EQ(f.rivals.leader().variant, "a");
  EXPECT_EQ(f.rivals.planned().variant, "new");
  EXPECT_TRUE(f.rivals.replaced());
  for (int k = 0; k < 20; ++k) f.search();
  EXPECT_EQ(f.rivals.leader().variant, "new");
  EXPECT_FALSE(f.rivals.replaced());
  f.rivals.begin({"new", 1}, f.films + 1);
  EXPECT_TRUE(f.rivals.leader().variant == "new" && !f.rivals.expected()) << "of another number";
  f.rivals.begin(first_choice, f.films + 1);
  EXPECT_EQ(f.rivals.leader(), first_choice);
}

/// Who is planned may change every few searches, as times tell: others are tried all the same.
TEST(Rivals, AreTriedWhoeverIsPlanned) {
  TimedFilm f{{{"planned2", 2}, {"planned1", 2}, {"a1", 1}, {"b1", 4}}, {}, 0, {}};
  f.begin();
  for (int k = 0; k < 60; ++k) {
    if (k % 4 == 0) f.rivals.go_on(k % 8 == 0 ? other_choices[0] : first_choice);
    f.search();
  }
  EXPECT_EQ(f.rivals.leader().variant, "a");
}

/// Nobody is looked for by who searches a few times only.
TEST(Rivals, AreExpectedWhereManySearchesCome) {
  Rivals rivals;
  rivals.begin(first_choice, 1);
  for (unsigned k = 0; k < 2 * Rivals::patience; ++k) {
    EXPECT_EQ(rivals.expected(), k >= Rivals::patience);
    EXPECT_EQ(rivals.next(), first_choice);
    rivals.took(1);
  }
  rivals.join(other_choices, 0);
  EXPECT_FALSE(rivals.expected());
  rivals.took(1);
  EXPECT_NE(rivals.next(), first_choice);
}

/// Of which nothing else is known.
ChainView of_radii(std::uint32_t n, float least, float greatest) {
  ChainView chain{};
  chain.size = n, chain.extent = {least, greatest, 100, 100};
  return chain;
}

/// A plan names as rivals what may be tried for its chain, each but its own choice, the safest first; nobody
/// where all pairs are compared.
TEST(Rivals, OfAPlanSuitTheChain) {
  const auto names = [](std::uint32_t n, float other_radius) {
    Machine machine = Machine::built_in();
    machine.cores = 1;
    const ChainView chain = of_radii(n, 1, other_radius);
    std::vector<std::string> all;
    for (const Contender& c : SearchPlan(n, {}, machine, {}, chain).rivals(chain.extent)) {
      all.push_back(c.variant);
      EXPECT_EQ(c.threads, 1u);
    }
    return all;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(4097, 1), (Names{"SphereTree", "Grid"}));
  EXPECT_EQ(names(4097, 2.1f), (Names{"SphereTree"}));
  EXPECT_EQ(names(4096, 1), (Names{"SphereTree", "Grid", "ChainTree"}));
  EXPECT_EQ(names(4, 1), Names{});
}

/// All threads, or one: how many pay is a guess.
TEST(Rivals, OfAPlanWithThreadsHaveOneToo) {
  Machine machine = Machine::built_in();
  machine.cores = 8;
  const ChainView chain = of_radii(1'000'000, 1, 3);
  const SearchPlan plan(chain.size, {}, machine, {}, chain);
  ASSERT_GT(plan.threads(), 1u);
  const std::vector<Contender> rivals = plan.rivals(chain.extent);
  EXPECT_DOUBLE_EQ(plan.worth_trying_ms(), 1.25 * plan.estimate_ms());
  ASSERT_EQ(rivals.size(), 2u);
  EXPECT_EQ(rivals[0], (Contender{plan.variant(), 1}));
  EXPECT_EQ(rivals[1], (Contender{"SphereTree", plan.threads()}));
  EXPECT_EQ(plan.named(rivals[1]), "SphereTree(threads=" + std::to_string(plan.threads()) + ")");
  EXPECT_EQ(plan.named({"ChainTree", 1}), "ChainTree");
  const std::string threads[] = {info_of(Omission::threads).name};
  const SearchPlan kept(chain.size, {}, machine, Omissions::without(threads), chain);
  for (const Contender& rival : kept.rivals(chain.extent))
    EXPECT_GT(rival.threads, 1u) << "none may be left out";
}

/// `auto` tries others on a chain that is searched again and again, and none when told; all are right.
TEST(Rivals, AreTriedByAutoAndAllAreRight) {
  // Fat, so that no machine searches it in what is usual, and short, so that no device does.
  const Chain yarn = open_input("yarn:n=1000").animation->frame(0);
  std::vector<Sphere> spheres(yarn.spheres().begin(), yarn.spheres().end());
  for (Sphere& s : spheres) s.radius *= 1.5f;
  const Chain chain(std::move(spheres));
  Collisions right;
  const auto other = StrategyRegistry::instance().make("Grid");
  other->build(chain);
  other->find(chain, {}, right);
  properties::sort(right.pairs);
  ASSERT_FALSE(right.pairs.empty());
  const auto searches_not_planned = [&](const char* name) {
    const auto variant = StrategyRegistry::instance().make(name);
    int others = 0;
    for (int k = 0; k < 60; ++k) {
      variant->build(chain);
      Collisions found;
      variant->find(chain, {}, found);
      properties::sort(found.pairs);
      EXPECT_EQ(found.pairs, right.pairs) << variant->answered_by();
      others += !variant->plan().front().reason.starts_with(variant->answered_by() + " by ");
    }
    return others;
  };
  EXPECT_GT(searches_not_planned("auto"), 0);
  EXPECT_EQ(searches_not_planned("auto(rivals=none)"), 0);
}

}  // namespace
}  // namespace catena
