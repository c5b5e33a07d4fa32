#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "catena/properties/testing/every_family.h"

/// The search by ranks is one more exact variant: every property on every family of chains, by ranks that are
/// threads, few and many, even and uneven, in chain order and by space, in one round and in as many as there
/// are blocks.
namespace catena::properties {
namespace {

class RanksProperties : public testing::TestWithParam<std::string> {};

TEST_P(RanksProperties, HoldOnEveryFamily) { expect_every_property(GetParam(), 1000, 1); }

INSTANTIATE_TEST_SUITE_P(Host, RanksProperties,
                         testing::Values("Ranks(ranks=1)", "Ranks(ranks=2,order=chain)", "Ranks(ranks=3)",
                                         "Ranks(ranks=3,order=space,blocks_at_once=1)",
                                         "Ranks(ranks=4,order=space,meetings=0)",
                                         "Ranks(ranks=3,order=chain,meetings=1)",
                                         "Ranks(ranks=5,order=chain,parts=uneven,blocks_at_once=2)",
                                         "Ranks(ranks=9,order=space,parts=uneven)"),
                         [](const auto& of) { return fmt::format("Case{}", of.index); });

}  // namespace
}  // namespace catena::properties
