#include "catena/core/default_floats.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <fstream>
#include <limits>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/chain/joints.h"
#include "catena/core/error.h"
#include "catena/properties/float_environment.h"

namespace catena {
namespace {

using properties::StrangeFloats;

TEST(DefaultFloats, StandOnlyWhereNothingIsStrange) {
  EXPECT_TRUE(DefaultFloats::stands());
  for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const StrangeFloats strange(rounding);
#if defined(__SSE__) || defined(__aarch64__)
    EXPECT_FALSE(DefaultFloats::stands()) << rounding;
#endif
    {
      const DefaultFloats floats;
      EXPECT_TRUE(DefaultFloats::stands()) << rounding;
      EXPECT_EQ(std::fegetround(), FE_TONEAREST);
    }
    EXPECT_EQ(std::fegetround(), rounding) << "the caller's comes back";
  }
  EXPECT_TRUE(DefaultFloats::stands());
#ifdef __SSE__
  for (const unsigned flushed : {0x8000u, 0x0040u}) {  // results alone, operands alone
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | flushed);
    const bool stands = DefaultFloats::stands();
    _mm_setcsr(before);
    EXPECT_FALSE(stands) << flushed;
  }
#endif
#ifdef __GLIBC__
  for (const int trapped : {FE_DIVBYZERO, FE_INVALID, FE_OVERFLOW, FE_UNDERFLOW}) {
    std::feclearexcept(FE_ALL_EXCEPT);
    if (feenableexcept(trapped) == -1) continue;  // the processor has no traps
    const bool stands = DefaultFloats::stands();
    volatile float infinite = 0;
    {
      const DefaultFloats floats;
      infinite = std::numeric_limits<float>::max();
      infinite = infinite * infinite / 0.0f;
    }
    const int again = fegetexcept();
    fedisableexcept(FE_ALL_EXCEPT);
    EXPECT_FALSE(stands) << trapped;
    EXPECT_EQ(again, trapped) << "the caller's come back";
  }
#endif
}

/// With subnormal numbers read as zero this radius is not negative, and this arc has no length.
TEST(DefaultFloats, AChainIsTheSameInEveryEnvironment) {
  constexpr float least = 0x1p-149f;
  const std::vector<Sphere> spheres{{0, 0, 0, least}, {3 * least, 0, 0, least}, {6 * least, 0, 0, least}};
  const StrangeFloats strange(FE_UPWARD);
  EXPECT_THROW(Chain({{0, 0, 0, -least}}), InputError);
  const Chain chain(spheres, {}, Exclusion::arc(2));
  const DefaultFloats floats;
  EXPECT_TRUE(chain.neighbours(0, 1));
  EXPECT_FALSE(chain.neighbours(0, 2));
}

/// Read as zero, these radii would have no reach, and no sphere a neighbour across the joint.
TEST(DefaultFloats, NeighboursAcrossJointsAreTheSameInEveryEnvironment) {
  constexpr float least = 0x1p-149f;
  const std::vector<Sphere> spheres{{0, 0, 0, least}, {3 * least, 0, 0, least}, {6 * least, 0, 0, least}};
  const std::vector<Pair> joint{{1, 2}};
  std::vector<Pair> found;
  {
    const StrangeFloats strange(FE_UPWARD);
    found = pairs_across_joints(spheres, {{0, 2, 3}, {0, 0}}, joint, Exclusion::arc(2));
  }
  EXPECT_EQ(found, joint);
}

/// The registry's wrapper must pass on every function of Variant: one that it does not know would quietly
/// answer for the variant.
TEST(DefaultFloats, TheRegistrysWrapperPassesOnAllOfVariant) {
  const auto text_of = [](const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(CATENA_SOURCE_DIR "/core/strategy/" + name).rdbuf();
    return text.str();
  };
  const auto functions = [](const std::string& text, const std::string& pattern) {
    std::set<std::string> names;
    const std::regex function(pattern);
    for (std::sregex_iterator at(text.begin(), text.end(), function), end; at != end; ++at)
      names.insert((*at)[1]);
    return names;
  };
  const auto all = functions(text_of("variant.h"), "virtual [A-Za-z:<>*]+ \\*?([a-z_]+)\\(");
  EXPECT_EQ(all.size(), 12u) << "whatever a function returns, it is looked for";
  EXPECT_EQ(functions(text_of("in_default_floats.h"), "variant_->([a-z_]+)\\("), all);
}

}  // namespace
}  // namespace catena
