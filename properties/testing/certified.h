#pragma once
#include <gtest/gtest.h>

#include <string>

#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/reference.h"
#include "catena/reference/verify.h"

namespace catena::properties {

/// The variant's evidence proves its answer on scenes of several kinds, and leaves whole subtrees out on the
/// way.
inline void expect_certified(const std::string& name) {
  const auto variant = StrategyRegistry::instance().make(name);
  ASSERT_NE(variant->evidence(), Accounting::none);
  for (const char* input : {"yarn:n=3000", "path1:n=2000", "hair:n=1500", "coil:n=1500,offset=1e6",
                            "walk:n=1000,scale=1e-25", "mixed_radii:n=1500"}) {
    const Chain chain = open_input(input).animation->frame(0);
    std::uint64_t proved = 0;
    const auto v = reference::verify_by_certificate(*variant, chain, 1u << 24, proved);
    EXPECT_EQ(v.verdict, reference::Verdict::exact) << name << " on " << input << ": " << v.reason;
    EXPECT_EQ(proved, reference::find(chain).pair_count) << name << " on " << input;
    ASSERT_TRUE(v.certificate);
    EXPECT_GT(v.certificate->discarded, 0u) << name << " on " << input;
    const std::uint64_t ends = variant->evidence() == Accounting::from_both_ends ? 2 : 1;
    EXPECT_LT(v.certificate->tested, ends * chain.size() * (chain.size() - 1) / 2)
        << name << " on " << input;
  }
}

}  // namespace catena::properties
