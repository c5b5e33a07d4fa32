#include "catena/reports/faults.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "catena/core/error.h"

namespace catena::reports {
namespace {

/// In a process of its own, whose report none of them is.
TEST(Faults, AreNotedAndSaidOnceAndRefusalsAreNone) {
  const auto all = [] {
    const auto throwing = [] { throw std::range_error("too far"); };
    const auto refusing = [] { throw CapacityError("too long"); };
    const bool right = attempt("Sound", [] {}) && !attempt("Refusing", refusing) &&
                       !attempt("Throwing", throwing) && !attempt("Throwing", throwing);
    std::exit(right ? static_cast<int>(noted_faults().size()) : 100);
  };
  EXPECT_EXIT(all(), testing::ExitedWithCode(1), "^catena report: Throwing[^\n]*too far[^\n]*\n$");
}

}  // namespace
}  // namespace catena::reports
