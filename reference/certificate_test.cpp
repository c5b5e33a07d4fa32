#include "catena/reference/certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "catena/core/hierarchy/sphere_bounds_visitor.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/compare.h"
#include "catena/reference/enclosure.h"
#include "catena/reference/exact_gap.h"
#include "catena/reference/reference.h"

namespace catena::reference {
namespace {

Chain tangle(std::uint32_t n, Strands strands = {}, Exclusion exclusion = {}) {
  std::mt19937 random(n);
  const auto unit = [&] { return static_cast<float>(random() % 2001) / 1000 - 1; };
  std::vector<Sphere> spheres;
  Sphere s{0, 0, 0, 0};
  for (std::uint32_t i = 0; i < n; ++i) {
    s = {s.x + unit(), s.y + unit(), s.z + unit(), 0.3f + unit() / 4};
    spheres.push_back(s);
  }
  return Chain(std::move(spheres), std::move(strands), std::move(exclusion));
}

/// Evidence as a list, so that a test can spoil it.
struct Recorded final : EvidenceSink, SphereBoundsVisitor {
  struct Line {
    void (EvidenceSink::*say)(std::uint32_t, std::uint32_t);
    std::uint32_t a, b;
  };
  struct Edge {
    std::uint32_t parent_id, child_id;
    Sphere64 parent, child;
  };
  void discarded(std::uint32_t a, std::uint32_t b) override {
    lines.push_back({&EvidenceSink::discarded, a, b});
  }
  void tested(std::uint32_t i, std::uint32_t j) override { lines.push_back({&EvidenceSink::tested, i, j}); }
  void excluded(std::uint32_t i, std::uint32_t j) override {
    lines.push_back({&EvidenceSink::excluded, i, j});
  }
  void sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
              const Sphere64& child) override {
    edges.push_back({parent_id, child_id, parent, child});
  }

  std::size_t first(void (EvidenceSink::*say)(std::uint32_t, std::uint32_t),
                    std::uint32_t least_b = 0) const {
    for (std::size_t k = 0; k < lines.size(); ++k)
      if (lines[k].say == say && lines[k].b >= least_b) return k;
    ADD_FAILURE() << "no such line";
    return 0;
  }
  CertificateReport check(const Chain& chain, Accounting accounting = Accounting::from_both_ends) const {
    EvidenceTree tree(chain);
    tree.tree({.nested = true});
    for (const Edge& e : edges) tree.edge(e.parent_id, e.parent, e.child_id, e.child);
    tree.complete();
    CertificateChecker checker(chain, tree, accounting, {});
    for (const Line& l : lines) (checker.*l.say)(l.a, l.b);
    return checker.report();
  }

  std::vector<Line> lines;
  std::vector<Edge> edges;
};

struct Recording {
  Chain chain = tangle(300);
  Recorded evidence;

  Recording() {
    const auto variant = StrategyRegistry::instance().make("aCPU2+CPU2");
    Collisions found;
    variant->build(chain);
    variant->visit_bounds(evidence);
    variant->find_with_evidence(chain, {}, found, evidence);
  }
  CertificateReport spoilt(const std::function<void(Recorded&)>& spoil) const {
    Recorded copy = evidence;
    spoil(copy);
    return copy.check(chain);
  }
};

const Recording& recording() {
  static const Recording one;
  return one;
}

TEST(Certificate, ProvesTheReferencesAnswerForEveryVariantThatHasOne) {
  const std::vector<Chain> chains{Chain(),
                                  tangle(1),
                                  tangle(2),
                                  tangle(3),
                                  tangle(385),
                                  tangle(1000),
                                  tangle(400, Strands{{0, 100, 101, 400}, {1, 0, 1}}, Exclusion::index(3)),
                                  tangle(300, Strands::one_closed(300), Exclusion::arc(1.5)),
                                  Chain(std::vector<Sphere>(100, Sphere{1, 2, 3, 0}))};
  int variants = 0;
  for (const auto& info : StrategyRegistry::instance().variants()) {
    if (info.unavailable || !info.exact) continue;
    const auto variant = StrategyRegistry::instance().make(info.name);
    if (variant->evidence() == Accounting::none) continue;
    ++variants;
    for (const Chain& chain : chains) {
      if (!has_evidence(*variant, chain)) continue;  // `auto` chose a device
      Collisions found;
      const Certified certified = certify(*variant, chain, {}, found);
      EXPECT_TRUE(certified.report.holds())
          << info.name << ", n = " << chain.size() << ": " << certified.report.fault();
      EXPECT_EQ(certified.answer, find(chain)) << info.name << ", n = " << chain.size();
      EXPECT_TRUE(compare(chain, certified.answer, found).right()) << info.name;
    }
  }
  EXPECT_GE(variants, 9);
}

TEST(Certificate, IsMuchSmallerThanAllPairs) {
  const auto report = recording().evidence.check(recording().chain);
  EXPECT_TRUE(report.holds()) << report.fault();
  EXPECT_LT(report.discarded + report.tested + report.excluded, 300u * 299 / 2);
}

TEST(Certificate, ADroppedLineIsMissed) {
  for (const auto say : {&EvidenceSink::discarded, &EvidenceSink::tested, &EvidenceSink::excluded}) {
    const auto report = recording().spoilt(
        [&](Recorded& e) { e.lines.erase(e.lines.begin() + static_cast<std::ptrdiff_t>(e.first(say))); });
    EXPECT_FALSE(report.each_once);
    EXPECT_EQ(report.not_separate, 0u);
  }
}

TEST(Certificate, APairTwiceIsNoticed) {
  for (const auto say : {&EvidenceSink::discarded, &EvidenceSink::tested, &EvidenceSink::excluded})
    EXPECT_FALSE(
        recording().spoilt([&](Recorded& e) { e.lines.push_back(e.lines[e.first(say)]); }).each_once);
}

TEST(Certificate, AsManyPairsButNotTheSameAreNoticed) {
  const auto report = recording().spoilt([](Recorded& e) {
    auto& line = e.lines[e.first(&EvidenceSink::tested)];
    line.b = line.b == 0 ? 2 : line.b - 1;
  });
  EXPECT_FALSE(report.each_once);
}

TEST(Certificate, FromOneEndTwiceIsNotFromBothEnds) {
  const auto report = recording().spoilt([](Recorded& e) {
    const auto tested = e.lines[e.first(&EvidenceSink::tested)];
    for (auto& line : e.lines)
      if (line.say == tested.say && line.a == tested.b && line.b == tested.a) std::swap(line.a, line.b);
  });
  EXPECT_FALSE(report.each_once);
}

TEST(Certificate, AFalseDiscardIsNotSeparate) {
  // Two spheres that overlap: instead of testing them, the search claims to have left one out.
  const auto report = recording().spoilt([](Recorded& e) {
    const Chain& chain = recording().chain;
    for (auto& line : e.lines)
      if (line.say == &EvidenceSink::tested && overlap(chain[line.a], chain[line.b])) {
        line.say = &EvidenceSink::discarded;
        return;
      }
    ADD_FAILURE() << "no overlapping pair";
  });
  EXPECT_TRUE(report.each_once);
  EXPECT_EQ(report.not_separate, 1u);
}

TEST(Certificate, ATestedPairCannotBeCalledExcluded) {
  const auto report = recording().spoilt(
      [](Recorded& e) { e.lines[e.first(&EvidenceSink::tested)].say = &EvidenceSink::excluded; });
  EXPECT_EQ(report.not_neighbours, 1u);
}

TEST(Certificate, ANodeThatDoesNotEncloseIsNoticed) {
  const auto report = recording().spoilt([](Recorded& e) {
    for (auto& edge : e.edges)  // one node, wherever it is shown
      for (auto* shown : {&edge.parent, &edge.child})
        if ((shown == &edge.parent ? edge.parent_id : edge.child_id) == 300)
          shown->radius = std::nextafter(shown->radius * 0.999, 0.0);
  });
  EXPECT_GT(report.tree.unenclosed, 0u);
}

TEST(Certificate, ANodeShownWithTwoBoundsIsNoticed) {
  const auto report = recording().spoilt([](Recorded& e) { e.edges.front().parent.radius *= 2; });
  EXPECT_GT(report.tree.misplaced, 0u);
}

TEST(Certificate, ALeafThatIsNotTheChainsSphereIsNoticed) {
  const auto report = recording().spoilt([](Recorded& e) {
    for (auto& edge : e.edges)
      if (edge.child_id == 5) edge.child.radius /= 2;
  });
  EXPECT_EQ(report.tree.foreign_leaves, 1u);
}

TEST(Certificate, ANodeBelowTwoParentsOrItselfIsNoticed) {
  EXPECT_GT(recording().spoilt([](Recorded& e) { e.edges.push_back(e.edges.front()); }).tree.misplaced, 0u);
  EXPECT_GT(recording()
                .spoilt([](Recorded& e) {
                  auto& [parent, child, bound, child_bound] = e.edges.front();
                  child = parent, child_bound = bound;
                })
                .tree.misplaced,
            0u);
}

/// Four spheres in a row, apart, and two trees: 4 holds 0 and 1, and 5 holds 1 and 2.
struct TwoTrees {
  Chain chain = Chain({{0, 0, 0, 1}, {10, 0, 0, 1}, {20, 0, 0, 1}, {30, 0, 0, 1}});
  EvidenceTree tree{chain};

  explicit TwoTrees(double radius = 6.5) {
    tree.tree({});
    for (const std::uint32_t i : {0u, 1u}) tree.edge(4, Sphere64{5, 0, 0, 6.5}, i, Everything{});
    tree.tree({});
    for (const std::uint32_t i : {1u, 2u}) tree.edge(5, Sphere64{15, 0, 0, radius}, i, Everything{});
  }
};

TEST(Certificate, ASphereMayBeInSeveralTreesOnceInEach) {
  TwoTrees two;
  two.tree.complete();
  CertificateChecker checker(two.chain, two.tree, Accounting::each_pair, {});
  checker.discarded(3, 4), checker.discarded(0, 5), checker.tested(1, 2), checker.discarded(2, 3);
  EXPECT_TRUE(checker.report().holds()) << checker.report().fault();
  checker.discarded(3, 5);
  EXPECT_FALSE(checker.report().each_once);

  TwoTrees twice;
  twice.tree.edge(5, Sphere64{15, 0, 0, 6.5}, 2, Everything{});
  twice.tree.complete();
  EXPECT_GT(twice.tree.faults().misplaced, 0u);

  TwoTrees shared;
  shared.tree.tree({});
  shared.tree.edge(6, Everything{}, 4, Sphere64{5, 0, 0, 6.5});
  shared.tree.tree({});
  shared.tree.edge(7, Everything{}, 4, Sphere64{5, 0, 0, 6.5});
  shared.tree.complete();
  EXPECT_GT(shared.tree.faults().misplaced, 0u);
}

TEST(Certificate, TheSecondTreeOfASphereMustEncloseItToo) {
  TwoTrees two(5.9);
  two.tree.complete();
  EXPECT_EQ(two.tree.faults().unenclosed, 2u);
}

/// It holds where there is no fault to name, and names each.
TEST(Certificate, NamesWhateverKeepsItFromHolding) {
  CertificateReport sound;
  sound.each_once = true, sound.discarded = sound.tested = sound.excluded = 3, sound.tree.bounds = 3;
  EXPECT_TRUE(sound.holds());
  EXPECT_EQ(sound.fault(), "");
  std::set<std::string> faults;
  const auto spoilt = [&](auto spoil) {
    CertificateReport report = sound;
    spoil(report);
    EXPECT_FALSE(report.holds());
    EXPECT_NE(report.fault(), "");
    EXPECT_TRUE(faults.insert(report.fault()).second) << report.fault();
  };
  spoilt([](auto& r) { r.unknown = 1; }), spoilt([](auto& r) { r.not_separate = 1; });
  spoilt([](auto& r) { r.not_neighbours = 1; }), spoilt([](auto& r) { r.each_once = false; });
  spoilt([](auto& r) { r.tree.unenclosed = 1; }), spoilt([](auto& r) { r.tree.foreign_leaves = 1; });
  spoilt([](auto& r) { r.tree.misplaced = 1; });
}

TEST(Certificate, UnknownNodesAndSpheresAreNoticed) {
  const auto report = recording().spoilt([](Recorded& e) {
    e.discarded(0, 5000);
    e.tested(7, 7);
    e.excluded(0, 300);
  });
  EXPECT_EQ(report.unknown, 3u);
}

TEST(Certificate, AccountsForUnorderedPairsOfASearchThatMeetsEachOnce) {
  const Chain chain = tangle(40);
  Recorded evidence;
  for (std::uint32_t i = 0; i < 40; ++i)
    for (std::uint32_t j = 0; j < i; ++j) (i + j) % 2 ? evidence.tested(i, j) : evidence.tested(j, i);
  EXPECT_TRUE(evidence.check(chain, Accounting::each_pair).each_once);
  EXPECT_FALSE(evidence.check(chain, Accounting::from_both_ends).each_once);
  evidence.lines.back() = evidence.lines.front();
  EXPECT_FALSE(evidence.check(chain, Accounting::each_pair).each_once);
}

TEST(Separate, TouchingIsNotAndOneUlpMoreIs) {
  const Sphere64 a{0, 0, 0, 1};
  for (double scale : {1.0, 0x1p-500, 0x1p500}) {
    const Sphere64 unit{0, 0, 0, scale};
    EXPECT_FALSE(separate(unit, {3 * scale, 4 * scale, 0, 4 * scale}));
    EXPECT_TRUE(separate(unit, {3 * scale, std::nextafter(4 * scale, 1e308), 0, 4 * scale}));
    EXPECT_FALSE(separate(unit, {3 * scale, std::nextafter(4 * scale, 0), 0, 4 * scale}));
  }
  EXPECT_FALSE(separate(a, {100, 0, 0, HUGE_VAL}));
  EXPECT_FALSE(separate(a, {NAN, 0, 0, 1}));
  EXPECT_FALSE(separate(a, {100, 0, 0, -1}));
}

TEST(Separate, FilterAndIntegersAgree) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 20'000; ++k) {
    const auto number = [&] {
      return std::ldexp(static_cast<double>(random() % 64), static_cast<int>(random() % 3));
    };
    const Sphere64 a{number(), number(), number(), number()}, b{number(), number(), number(), number()};
    EXPECT_EQ(separate(a, b), separate_by_integers(a, b));
  }
}

}  // namespace
}  // namespace catena::reference
