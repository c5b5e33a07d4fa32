#include "catena/core/arithmetic/arithmetic_policy.h"

#include <gtest/gtest.h>

#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/core/arithmetic/robust.h"

namespace catena {
namespace {

static_assert(ArithmeticPolicy<Robust> && ArithmeticPolicy<Literal> && ArithmeticPolicy<Double>);
static_assert(OverlapTests<Robust::InRange> && !ArithmeticPolicy<Robust::InRange>, "it makes no parents");

/// Each lacks one thing.
struct NoParent : Robust {
  static Sphere64 parent(const Sphere&, const Sphere&);
};
struct NoName : Robust {
  static constexpr int name = 1;
};
struct NoDecision : Robust {
  static int may_overlap(const Sphere&, const Sphere&);
};
struct ForeignTests : Robust {
  using InRange = Double;
};
static_assert(!ArithmeticPolicy<NoParent> && !ArithmeticPolicy<NoName> && !ArithmeticPolicy<NoDecision> &&
              !ArithmeticPolicy<ForeignTests> && !ArithmeticPolicy<int>);

TEST(ArithmeticPolicy, TestsInRangeDecideAsTheWholeArithmetic) {
  const Sphere a{0, 0, 0, 1}, touching{2, 0, 0, 1}, apart{3, 0, 0, 1};
  const auto decide = []<ArithmeticPolicy A>(A, const Sphere& p, const Sphere& q) {
    using Tests = typename A::InRange;
    EXPECT_EQ(A::overlap(A::bound(p), A::bound(q)), Tests::overlap(Tests::bound(p), Tests::bound(q)))
        << A::name;
    return A::overlap(A::bound(p), A::bound(q));
  };
  for (const bool all :
       {decide(Robust{}, a, touching), decide(Literal{}, a, touching), decide(Double{}, a, touching)})
    EXPECT_TRUE(all);
  for (const bool any : {decide(Robust{}, a, apart), decide(Literal{}, a, apart), decide(Double{}, a, apart)})
    EXPECT_FALSE(any);
}

}  // namespace
}  // namespace catena
