#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/allocations.h"
#include "catena/properties/property.h"

// Each clause of each statement fails for a variant that breaks it and nothing else: the museum's mutants
// break many at once, so that one which cannot fail any more would not be missed.
namespace catena::properties {
namespace {

using Want = Request::Want;

/// What a variant was told so far.
struct Told {
  const Chain* chain = nullptr;  ///< of the last build or update; null: none
  int builds = 0, updates = 0;
  int unsearched = 0;  ///< updates since the last find
  Request prepared;
  bool told_all = true, told_none = false;  ///< by the last update
};
struct Question {
  const Told& told;
  const Chain& chain;
  const Request& request;
};

/// All pairs, but for one fault.
class Faulty final : public Variant {
 public:
  struct Fault {
    /// After an honest answer.
    std::function<void(const Question&, Collisions&)> spoil = {};
    /// In place of one, where it returns true.
    std::function<bool(const Question&, Collisions&)> instead = {};
    /// Of build and update.
    std::function<void(const Told&)> begin = {};
    std::function<void(const Told&, BoundsVisitor&)> bounds = {};
  };
  explicit Faulty(const Fault& fault) : fault_(fault) {}

  void prepare(const Request& request) override { told_.prepared = request; }
  void build(const Chain& chain) override { ++told_.builds, told_.told_all = true, begin(chain); }
  void update(const Chain& chain, const Moved& moved) override {
    ++told_.updates, ++told_.unsearched, told_.told_all = moved.everything() && moved.shift() == 0;
    told_.told_none = !moved.everything() && moved.ranges().empty();
    begin(chain);
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    const Question question{told_, chain, request};
    if (fault_.instead && fault_.instead(question, result)) return searched();
    if (told_.chain == nullptr || held_.size() != chain.size())
      throw std::logic_error("find: not the chain of the last build");
    const auto honest = StrategyRegistry::instance().make("CPU1");
    honest->build(chain);
    honest->find(chain, request, result);
    if (fault_.spoil) fault_.spoil(question, result);
    searched();
  }
  void visit_bounds(BoundsVisitor& visitor) const override {
    if (fault_.bounds && told_.chain != nullptr) fault_.bounds(told_, visitor);
  }
  Timings timings() const override { return {}; }

 private:
  void searched() { told_.unsearched = 0; }
  void begin(const Chain& chain) {
    held_ = chain, told_.chain = &held_;
    if (fault_.begin) fault_.begin(told_);
  }
  const Fault fault_;
  Chain held_;
  Told told_;
};

void drop_a_pair(Collisions& found) {
  if (found.pairs.empty()) return;
  const Pair gone = found.pairs.back();
  found.pairs.pop_back(), --found.pair_count;
  --found.count[gone.i], --found.count[gone.j];
  found.found = found.pair_count > 0;
}

/// A row whose every sphere touches the next but one, in strands and with a joint, so that each relation has
/// something to change.
Case row(bool strands = false) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < 24; ++i)
    spheres.push_back({static_cast<float>(i), i % 4 ? 0 : 0.25f, 0, 1.25f});
  Exclusion exclusion = Exclusion::index(1);
  if (strands) exclusion.extra_pairs = {{3, 5}};
  return Case::of(
      Chain(std::move(spheres), strands ? Strands{{0, 7, 16, 24}, {0, 0, 0}} : Strands{}, exclusion));
}

std::optional<std::string> asked(const std::string& property, const Faulty::Fault& fault, const Case& test,
                                 VariantInfo info = {}) {
  if (info.name.empty()) info.name = "faulty";
  const Subject subject{info, [&] { return std::make_unique<Faulty>(fault); }};
  for (const auto& p : PropertyRegistry::instance().make_all())
    if (p->name() == property) {
      Faulty variant(fault);
      return p->check(subject, variant, test);
    }
  ADD_FAILURE() << "there is no property " << property;
  return std::nullopt;
}

void expect_noticed(const std::string& property, const Faulty::Fault& fault, const std::string& words,
                    const Case& test = row(), const VariantInfo& info = {}) {
  EXPECT_EQ(asked(property, {}, test, info), std::nullopt) << property;
  const auto fault_found = asked(property, fault, test, info);
  ASSERT_TRUE(fault_found) << property << ": not '" << words << "'";
  EXPECT_NE(fault_found->find(words), std::string::npos) << property << ": " << *fault_found;
}

VariantInfo rounded() {
  VariantInfo info;
  info.exact = false;
  return info;
}

TEST(Statements, NoticeAnAnswerToAChainThatWasNotBuilt) {
  const auto answers = [](bool built) {
    return Faulty::Fault{.instead = [=](const Question& q, Collisions& found) {
      if ((q.told.chain != nullptr) != built || (built && q.told.chain->size() == q.chain.size()))
        return false;
      found = {false, 0, std::vector<std::uint32_t>(q.chain.size(), 0), {}};
      return true;
    }};
  };
  expect_noticed("build first", answers(false), "never built: an answer");
  expect_noticed("build first", answers(true), "built on another chain: an answer");
}

TEST(Statements, NoticeAnswersThatChange) {
  const auto where = [](auto when) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (when(q.told)) drop_a_pair(found);
    }};
  };
  expect_noticed("same answer again", where([](const Told& t) { return t.builds == 2; }),
                 "in the second run");
  expect_noticed("same answer again",
                 where([objects = std::make_shared<std::vector<const Told*>>()](const Told& t) {
                   if (std::ranges::find(*objects, &t) == objects->end()) objects->push_back(&t);
                   return &t != objects->front();
                 }),
                 "from a fresh object");
  expect_noticed("same answer again", where([](const Told& t) { return t.builds == 4; }),
                 "after another chain");
}

TEST(Statements, NoticeWrongPairsAndCounts) {
  const auto spoilt = [](auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question&, Collisions& found) { spoil(found); }};
  };
  expect_noticed("pair set", spoilt(drop_a_pair), "1 pairs missing");
  expect_noticed("pair set", spoilt([](Collisions& found) { ++found.count[0]; }), "1 counts wrong");
  expect_noticed("pair set", spoilt([](Collisions& found) { ++found.pair_count; }), "0 counts wrong");
  const auto repeats = [](Collisions& found) { found.pairs.push_back(found.pairs[0]), ++found.pair_count; };
  expect_noticed("pair set", spoilt(repeats), "1 repeated");
  expect_noticed("pair set", spoilt(repeats), "1 repeated", row(), rounded());
  EXPECT_EQ(asked("pair set", spoilt(drop_a_pair), row(), rounded()), std::nullopt);
}

TEST(Statements, NoticeAPairThatIsLostInAChangedChain) {
  for (const char* relation :
       {"permuted and negated axes", "first part on its own", "second part on its own", "relabelled strands",
        "reversed chain", "scaling by a power of two", "subdivision", "exact translation"}) {
    const Case test = row(true);
    const auto elsewhere = [&](const Question& q) {
      return !std::ranges::equal(q.chain.spheres(), test.chain.spheres());
    };
    expect_noticed(relation,
                   {.spoil =
                        [&](const Question& q, Collisions& found) {
                          if (elsewhere(q)) drop_a_pair(found);
                        }},
                   "is missing", test);
    expect_noticed(relation,
                   {.spoil =
                        [&](const Question& q, Collisions& found) {
                          if (elsewhere(q)) found.pairs.push_back({0, q.chain.size() - 1});
                        }},
                   "is invented", test);
  }
  const Case test = row();
  expect_noticed("larger radii only add pairs",
                 {.spoil =
                      [&](const Question& q, Collisions& found) {
                        std::erase(found.pairs, test.exact.pairs.front());
                        static_cast<void>(q);
                      }},
                 "are left", test);
  // Some radii grow by more than the last bit.
  expect_noticed("larger radii only add pairs",
                 {.spoil =
                      [&](const Question& q, Collisions& found) {
                        if (q.chain[1].radius > 1.2f * test.chain[1].radius)
                          std::erase(found.pairs, test.exact.pairs.front());
                      }},
                 "are left", test);
}

TEST(Statements, NoticeWhatIsWrongOfAFloatingPointEnvironment) {
  expect_noticed("any floating-point environment",
                 {.begin = [](const Told&) { std::fesetround(FE_TONEAREST); }}, "environment is lost");
  for (const int rounding : {FE_UPWARD, FE_TOWARDZERO})
    expect_noticed("any floating-point environment",
                   {.spoil =
                        [=](const Question&, Collisions& found) {
                          if (std::fegetround() == rounding) drop_a_pair(found);
                        }},
                   "another answer");
  expect_noticed("any floating-point environment",
                 {.begin =
                      [](const Told& told) {
                        if (told.updates > 0) std::fesetround(FE_TONEAREST);
                      }},
                 "environment is lost");
}

TEST(Statements, NoticeWhatIsWrongPastALimitOnPairs) {
  const std::uint64_t pairs = row().exact.pair_count;
  ASSERT_GT(pairs, 3u);
  const auto wrong = [&](auto when, auto instead) {
    return Faulty::Fault{.instead = [=](const Question& q, Collisions& found) {
      if (!when(q.request)) return false;
      const auto honest = StrategyRegistry::instance().make("CPU1");
      honest->build(q.chain);
      Request unlimited = q.request;
      unlimited.pair_limit = Request().pair_limit;
      honest->find(q.chain, unlimited, found);
      instead(q.request, found);
      return true;
    }};
  };
  const auto limit = [](std::uint64_t at) {
    return [=](const Request& r) { return r.want == Want::pairs && r.pair_limit == at; };
  };
  const auto nothing = [](const Request&, Collisions&) {};
  for (const std::uint64_t at : {pairs - 1, pairs / 2, std::uint64_t{0}})
    expect_noticed("pair limit", wrong(limit(at), nothing), "pass a limit of " + std::to_string(at));
  expect_noticed("pair limit",
                 wrong(limit(pairs / 2),
                       [=](const Request& r, Collisions& found) {
                         found.pairs.clear();
                         throw PairLimitExceeded(pairs - 1, r.pair_limit);
                       }),
                 "says");
  expect_noticed("pair limit",
                 wrong(limit(pairs / 2),
                       [=](const Request& r, Collisions&) { throw PairLimitExceeded(pairs, r.pair_limit); }),
                 "past the limit");
  expect_noticed("pair limit",
                 wrong([](const Request& r) { return r.want == Want::counts; },
                       [](const Request&, Collisions& found) { ++found.count[0]; }),
                 "counts differ");
  expect_noticed("pair limit",
                 wrong(limit(pairs), [](const Request&, Collisions& found) { found.pairs.pop_back(); }),
                 "pairs differ");
}

TEST(Statements, NoticeWhatIsWrongOfAPartOfTheSpheres) {
  const auto part = [](Want want, auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (q.request.want == want && q.request.queries != SphereRange{}) spoil(q.request, found);
    }};
  };
  const auto with_pairs = [&](auto spoil) { return part(Want::pairs, spoil); };
  expect_noticed("query ranges", with_pairs([](const Request& r, Collisions& found) {
                   found.count[r.queries.contains(0) ? 23 : 0] = 1;
                 }),
                 "was not asked about");
  expect_noticed(
      "query ranges", with_pairs([](const Request& r, Collisions& found) {
        found.pairs.push_back(r.queries.contains(0) ? Pair{20, 22} : Pair{0, 2}), ++found.pair_count;
      }),
      "was not asked about");
  expect_noticed("query ranges", with_pairs([](const Request&, Collisions& found) { ++found.pair_count; }),
                 "but pair_count");
  expect_noticed("query ranges", with_pairs([](const Request&, Collisions& found) {
                   if (!found.pairs.empty()) found.pairs.pop_back(), --found.pair_count;
                 }),
                 "or others");
  expect_noticed("query ranges", with_pairs([](const Request& r, Collisions& found) {
                   if (r.queries.contains(0)) ++found.count[0];
                 }),
                 "counts by parts");
  expect_noticed("query ranges",
                 part(Want::any, [](const Request&, Collisions& found) { found.found = !found.found; }),
                 "says found");
}

TEST(Statements, NoticeRequestsThatDisagree) {
  const auto where = [](Want prepared, Want want, auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (q.told.prepared.want == prepared && q.request.want == want) spoil(found);
    }};
  };
  const auto other_answer = [](Collisions& found) { found.found = !found.found; };
  const auto other_count = [](Collisions& found) { ++found.count[0]; };
  expect_noticed("requests agree", where(Want::pairs, Want::any, other_answer), "found differs when less");
  expect_noticed("requests agree", where(Want::pairs, Want::counts, other_count), "counts differ when less");
  expect_noticed("requests agree",
                 where(Want::pairs, Want::pairs, [](Collisions& found) { found.pairs.pop_back(); }),
                 "but pair_count");
  expect_noticed("requests agree", where(Want::counts, Want::counts, other_count), "counts differ between");
  expect_noticed("requests agree",
                 where(Want::counts, Want::counts, [](Collisions& found) { ++found.pair_count; }),
                 "with counts");
  for (const Want want : {Want::any, Want::counts})
    expect_noticed("requests agree", where(want, want, other_answer), "but found is");
  for (const Want want : {Want::any, Want::counts})
    expect_noticed("requests agree",
                   where(want, want,
                         [](Collisions& found) {
                           found.pairs = {{0, 2}};
                         }),
                   "nobody asked for");
}

/// Two spheres a node, in one tree, whose bounds are `wide`.
void show_twos(const Chain& chain, BoundsVisitor& visitor, double wide, std::uint32_t first = 0) {
  visitor.tree({.nested = true});
  for (std::uint32_t i = first; i + 1 < chain.size(); i += 2)
    for (const std::uint32_t k : {i, i + 1})
      visitor.edge(chain.size() + i, Sphere64{chain[i].x, chain[i].y, chain[i].z, wide}, k,
                   Sphere64{chain[k].x, chain[k].y, chain[k].z, chain[k].radius});
}

TEST(Statements, NoticeWhatIsWrongOfBounds) {
  const Case test = row();
  const auto shown = [](auto show) {
    return Faulty::Fault{
        .bounds = [=](const Told& told, BoundsVisitor& visitor) { show(*told.chain, visitor); }};
  };
  EXPECT_EQ(asked("enclosure", shown([](const Chain& c, BoundsVisitor& v) { show_twos(c, v, 3); }), test),
            std::nullopt);
  expect_noticed("enclosure", shown([](const Chain& c, BoundsVisitor& v) { show_twos(c, v, 1.5); }),
                 "do not enclose");
  expect_noticed("enclosure", shown([](const Chain& c, BoundsVisitor& v) {
                   v.edge(c.size(), Sphere64{0, 0, 0, 99}, 0, Sphere64{0, 0, 0, 9});
                 }),
                 "are not the chain's spheres");
  expect_noticed("enclosure", shown([](const Chain& c, BoundsVisitor& v) {
                   v.tree({.nested = false});
                   for (const double radius : {99, 98})
                     v.edge(c.size(), Sphere64{0, 0, 0, radius}, 0, Everything{});
                 }),
                 "not one place and bound");
}

TEST(Statements, NoticeUpdatesThatAreNoBuilds) {
  const auto after_update = [](auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (q.told.updates > 0 && q.request.want == Want::pairs) spoil(q.told, found);
    }};
  };
  expect_noticed("update is build", after_update([](const Told&, Collisions& found) { drop_a_pair(found); }),
                 "not exact");
  expect_noticed("update is build", after_update([](const Told& told, Collisions& found) {
                   if (!told.told_all) drop_a_pair(found);
                 }),
                 "told what moved");
  expect_noticed("update is build", after_update([](const Told& told, Collisions& found) {
                   if (told.told_none) drop_a_pair(found);
                 }),
                 "told what moved");
  expect_noticed("update is build", after_update([](const Told& told, Collisions& found) {
                   if (told.updates % 2 == 0) drop_a_pair(found);
                 }),
                 "on the way back");
  const auto drops = after_update([](const Told&, Collisions& found) { drop_a_pair(found); });
  expect_noticed("update is build", drops, "pairs after update", row(), rounded());
  const auto counts = after_update([](const Told&, Collisions& found) { ++found.count[0]; });
  expect_noticed("update is build", counts, "pairs after update", row(), rounded());

  const auto shown = [](auto show) {
    return Faulty::Fault{.bounds = [=](const Told& told, BoundsVisitor& visitor) {
      show(*told.chain, visitor, told.updates > 0);
    }};
  };
  expect_noticed("update is build", shown([](const Chain& c, BoundsVisitor& v, bool updated) {
                   show_twos(c, v, 1e9, updated ? 2 : 0);
                 }),
                 "another shape");
  expect_noticed("update is build", shown([](const Chain& c, BoundsVisitor& v, bool updated) {
                   show_twos(c, v, updated ? 1e-9 : 1e9);
                 }),
                 "do not enclose after update");
  VariantInfo same_bits;
  same_bits.promises.same_bits = true;
  expect_noticed("update is build", shown([](const Chain& c, BoundsVisitor& v, bool updated) {
                   show_twos(c, v, updated ? 2e9 : 1e9);
                 }),
                 "a bound after update", row(), same_bits);
}

TEST(Statements, NoticeAllocations) {
  if (Allocations::counter() == nullptr) GTEST_SKIP() << "nobody counts";
  const auto allocate = [] { ::operator delete(::operator new(8)); };
  /// Answers from memory that it has.
  const auto quiet = [=](auto when) {
    return Faulty::Fault{.instead =
                             [=](const Question& q, Collisions& found) {
                               found = {false, 0, std::move(found.count), std::move(found.pairs)};
                               found.pairs.clear();
                               found.count.assign(q.request.want == Want::any ? 0 : q.chain.size(), 0);
                               if (when(q.request.want)) allocate();
                               return true;
                             },
                         .begin = {}};
  };
  const auto never = [](Want) { return false; };
  EXPECT_EQ(asked("no allocation once warm", quiet(never), row()), std::nullopt);
  auto in_update = quiet(never);
  in_update.begin = [=](const Told& told) {
    if (told.updates > 1) allocate();
  };
  const auto update = asked("no allocation once warm", in_update, row());
  ASSERT_TRUE(update);
  EXPECT_NE(update->find("in two updates"), std::string::npos) << *update;
  for (const auto& [want, name] :
       {std::pair{Want::pairs, "pairs"}, {Want::counts, "counts"}, {Want::any, "any"}}) {
    const auto find =
        asked("no allocation once warm", quiet([=](Want asked) { return asked == want; }), row());
    ASSERT_TRUE(find) << name;
    EXPECT_NE(find->find(std::string("in a find of ") + name), std::string::npos) << *find;
  }
}

TEST(Statements, NoticeFramesThatAreAnsweredWrongly) {
  const Case test = row();
  const auto spoilt = [](auto spoil) {
    return Faulty::Fault{.spoil = [=](const Question& q, Collisions& found) {
      if (q.told.updates > 0) spoil(q, found);
    }};
  };
  expect_noticed("frame after frame", spoilt([](const Question&, Collisions& found) {
                   if (!found.pairs.empty()) drop_a_pair(found);
                 }),
                 "pairs, exactly");
  expect_noticed("frame after frame", spoilt([](const Question& q, Collisions& found) {
                   if (q.request.want == Want::counts) ++found.count[0];
                 }),
                 "other counts alone");
  expect_noticed("frame after frame", spoilt([](const Question& q, Collisions& found) {
                   if (q.request.want == Want::any) found.found = !found.found;
                 }),
                 "yes or no");
  // What a caller tells is told, ranges and shifts.
  expect_noticed("frame after frame", spoilt([](const Question& q, Collisions& found) {
                   if (!q.told.told_all) drop_a_pair(found);
                 }),
                 ", parts: ");
  // What a film of a short chain is made of.
  const auto miscounted = [&](auto when) {
    return spoilt([=](const Question& q, Collisions& found) {
      if (q.request.want == Want::pairs && when(q.chain)) ++found.count[0];
    });
  };
  const float radius = test.chain[0].radius;
  expect_noticed("frame after frame",
                 miscounted([](const Chain& c) { return c[c.size() / 2] == c[c.size() / 8]; }),
                 ", shift but for a sphere: ");
  expect_noticed("frame after frame", miscounted([](const Chain& c) { return c[0].x != std::floor(c[0].x); }),
                 ", drift: ");
  expect_noticed("frame after frame", miscounted([=](const Chain& c) { return c[0].radius > radius; }),
                 ", growth: ");
  expect_noticed("frame after frame", miscounted([=](const Chain& c) { return c[0].radius < radius; }),
                 ", shrinking: ");
  // Frames that are not searched are updated all the same.
  expect_noticed("frame after frame", spoilt([](const Question& q, Collisions& found) {
                   if (q.told.unsearched > 1) drop_a_pair(found);
                 }),
                 "pairs, exactly");
}

TEST(Statements, NoticeAProofOfAnotherNumberOfPairs) {
  const Case right = row();
  reference::Answer more = right.exact;
  ++more.pair_count;
  const Case wrong(right.chain, more);
  const auto variant = StrategyRegistry::instance().make("aCPU2+CPU2");
  for (const auto& property : PropertyRegistry::instance().make_all()) {
    if (property->name() != "evidence") continue;
    EXPECT_EQ(property->check(Subject::named("aCPU2+CPU2"), *variant, right), std::nullopt);
    const auto fault = property->check(Subject::named("aCPU2+CPU2"), *variant, wrong);
    ASSERT_TRUE(fault);
    EXPECT_NE(fault->find("pairs proved"), std::string::npos) << *fault;
  }
}

}  // namespace
}  // namespace catena::properties
